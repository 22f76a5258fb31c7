#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/statistics.h"

namespace glovebench::eval {

/// [trajectory][noise seed][frame]; empty without value, as for a lost frame.
using Sample = std::vector<std::vector<std::vector<std::optional<double>>>>;

/// `value` is empty without values, `interval` also with too few.
struct Estimated {
  std::optional<double> value;
  std::optional<reports::ConfidenceInterval> interval;
};

std::optional<double> mean(const Sample& sample);
Estimated estimate_mean(const Sample& sample);

/// `combine` of the samples' means. All samples must have the same frames; these are resampled together.
Estimated estimate(std::span<const Sample> samples,
                   const std::function<std::optional<double>(std::span<const double> means)>& combine);

/// Mean of a - b over frames with both values.
Estimated estimate_difference(const Sample& a, const Sample& b);

/// Bootstrap interval of a statistic of `count` things, named `over`. `drawn`: indices, some repeated. Empty if
/// count < 2.
std::optional<reports::ConfidenceInterval> interval_over(
    int count, const std::string& over,
    const std::function<std::optional<double>(std::span<const int> drawn)>& statistic);

/// Keeps frames where `keep` is neither empty nor 0.
Sample where(const Sample& sample, const Sample& keep);

}  // namespace glovebench::eval
