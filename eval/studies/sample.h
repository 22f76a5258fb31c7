#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/statistics.h"

namespace glovebench::eval {

/// One value a frame, of one setting: by stratum (a trajectory, which is not drawn again), noise seed and frame. No
/// value where a frame has none, e.g. a lost one.
using Sample = std::vector<std::vector<std::vector<std::optional<double>>>>;

/// A number with its interval. Both are empty if nothing has a value; the interval also if there is too little to
/// draw from.
struct Estimated {
  std::optional<double> value;
  std::optional<reports::ConfidenceInterval> interval;
};

/// Of all values, whatever stratum or seed they are of.
std::optional<double> mean(const Sample& sample);
Estimated estimate_mean(const Sample& sample);

/// What `combine` makes of the samples' means. The samples have the same shape: their frames are the same frames,
/// and the interval draws them together.
Estimated estimate(std::span<const Sample> samples,
                   const std::function<std::optional<double>(std::span<const double> means)>& combine);

/// The mean of a - b over the frames that have both values.
Estimated estimate_difference(const Sample& a, const Sample& b);

/// Interval of a statistic of `count` things that are drawn again one by one: it gets the numbers of those drawn,
/// some repeated, others missing. `over` names them. Empty if there are fewer than two.
std::optional<reports::ConfidenceInterval> interval_over(
    int count, const std::string& over,
    const std::function<std::optional<double>(std::span<const int> drawn)>& statistic);

/// The sample with only those frames in which `keep` holds a value that is not 0.
Sample where(const Sample& sample, const Sample& keep);

}  // namespace glovebench::eval
