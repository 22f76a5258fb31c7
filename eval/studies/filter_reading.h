#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::eval {

/// By frame; empty for a lost one.
using ErrorSeries = std::vector<std::optional<double>>;

/// Each error over the one before it, where errors fall and stay above 0.001 (smaller printed ones have too few
/// digits). While the hand rests, it is the share that the filter keeps.
std::vector<double> falling_ratios(const ErrorSeries& errors);
/// Autocorrelation at one frame: the sum of products of successive deviations from the mean, over that of their
/// squares. A slow filter brings it near 1. Empty without two different values.
std::optional<double> autocorrelation(const ErrorSeries& errors);

/// Statistics of the printed Figures 5 and 6, beside our experiments with both profiles.
/// Paper: section III-C, Figures 5 and 6.
reports::Table filter_table(const std::string& name, const reports::RunResult& paper,
                            const reports::RunResult& literal);

}  // namespace glovebench::eval
