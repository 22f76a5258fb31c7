#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::eval {

/// Of successive frames; empty for a lost one.
using ErrorSeries = std::vector<std::optional<double>>;

/// error / error before, at frames at which the error falls and stays above 0.001: smaller printed errors have too
/// few digits. A posture that keeps a share of the previous one has this share while the hand rests.
std::vector<double> falling_ratios(const ErrorSeries& errors);
/// Autocorrelation at one frame: the sum of the products of successive deviations from the mean, over that of the
/// squares. Near 1 if the errors pass through a slow filter. Empty without two values that differ.
std::optional<double> autocorrelation(const ErrorSeries& errors);

/// Statistics of the printed curves of Figures 5 and 6 beside those of our experiments with both profiles.
/// Paper: section III-C, Figures 5 and 6.
reports::Table filter_table(const std::string& name, const reports::RunResult& paper,
                            const reports::RunResult& literal);

}  // namespace glovebench::eval
