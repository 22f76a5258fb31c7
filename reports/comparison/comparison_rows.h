#pragma once

#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/paired_bootstrap.h"

namespace glovebench::reports {

/// Rows of all experiments together and of each: what the family error is shared by.
int row_count(size_t metrics, size_t experiments);
/// The rows of compare_results: first those over all experiments, then experiment by experiment. `draws` are of
/// config's seed and number of resamples; one object may serve many comparisons.
std::vector<ComparisonRow> comparison_rows(const Pairing& pairing, const NoiseFloor* floor,
                                           const CompareConfig& config, Draws& draws);

}  // namespace glovebench::reports
