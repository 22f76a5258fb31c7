#pragma once

#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/paired_bootstrap.h"

namespace glovebench::reports {

/// Rows that share the family error: all experiments and each.
int row_count(size_t metrics, size_t experiments);
/// kAllExperiments first. `draws` must have `config`'s seed and resamples.
std::vector<ComparisonRow> comparison_rows(const Pairing& pairing, const NoiseFloor* floor,
                                           const CompareConfig& config, Draws& draws);

}  // namespace glovebench::reports
