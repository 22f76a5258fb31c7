#pragma once

#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/paired_bootstrap.h"

namespace glovebench::reports {

/// Rows of all experiments and of each; they share the family error.
int row_count(size_t metrics, size_t experiments);
/// Rows over all experiments first, then each. `draws` must have the seed and resamples of `config`; comparisons
/// may share it.
std::vector<ComparisonRow> comparison_rows(const Pairing& pairing, const NoiseFloor* floor,
                                           const CompareConfig& config, Draws& draws);

}  // namespace glovebench::reports
