#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::eval {

/// By frame; empty for a lost one.
using ErrorSeries = std::vector<std::optional<double>>;

/// Each error over the one before it, where errors fall and stay above 0.001. At rest it is the share that the
/// filter keeps.
std::vector<double> falling_ratios(const ErrorSeries& errors);
/// Autocorrelation at a lag of one frame; near 1 for a slow filter. Empty without two different values.
std::optional<double> autocorrelation(const ErrorSeries& errors);

/// The printed Figures 5 and 6, beside our experiments with both profiles.
/// Paper: section III-C.
reports::Table filter_table(const std::string& name, const reports::RunResult& paper,
                            const reports::RunResult& literal);

}  // namespace glovebench::eval
