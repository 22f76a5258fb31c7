#pragma once

#include <string_view>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/paired_bootstrap.h"

namespace glovebench::reports {

/// Files round to 1e-6 of a unit: nothing smaller decides.
inline constexpr double kNegligible = 1e-6;
/// Is the difference at least the minimum effect?
bool reaches(double difference, double minimum_effect);
/// Of the row's difference, interval and minimum effect.
Verdict verdict_of(const ComparisonRow& row);

/// Below this a difference can come from another machine, or is fewer than two frames of a share. `frames` of all
/// seeds.
double least_effect(const Metric& metric, int frames);
/// The noise floor's, or the default; never below least_effect. `seeds` of each result: fewer than the floor is for
/// raise it, as the spread of their mean is larger. `floor` may be null.
double minimum_effect(const Metric& metric, std::string_view experiment, int frames, int seeds,
                      const NoiseFloor* floor);

/// Rows of all experiments together and of each: what the family error is shared by.
int row_count(size_t metrics, size_t experiments);
/// The rows of compare_results: first those over all experiments, then experiment by experiment. `draws` are of
/// config's seed and number of resamples; one object may serve many comparisons.
std::vector<ComparisonRow> comparison_rows(const Pairing& pairing, const NoiseFloor* floor,
                                           const CompareConfig& config, Draws& draws);

}  // namespace glovebench::reports
