#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/json_cursor.h"

namespace glovebench::reports {

// Statistics of an empty set are empty.
// Throws: std::logic_error for a value that is not finite.

std::optional<double> mean(std::span<const double> values);
/// Mean of the values that are not empty.
template <typename Range, typename Value = std::identity>
std::optional<double> mean_present(Range&& range, const Value& value_of = {}) {
  std::vector<double> present;
  for (const auto& each : range)
    if (const std::optional<double> value = std::invoke(value_of, each)) present.push_back(*value);
  return mean(present);
}
std::optional<double> rms(std::span<const double> values);
/// `share`: 0..1. Interpolates linearly at rank share * (n - 1).
std::optional<double> percentile(std::span<const double> values, double share);

struct Aggregate {
  int count = 0;
  std::optional<double> mean;
  std::optional<double> median;
  std::optional<double> rms;
  std::optional<double> p95;
  std::optional<double> max;

  friend bool operator==(const Aggregate&, const Aggregate&) = default;
};
Aggregate aggregate(std::span<const double> values);

/// Share of keypoints within each threshold (PCK).
struct PckCurve {
  std::vector<double> thresholds_mm;
  std::vector<double> shares;
  std::optional<double> area;  ///< under the curve (trapezoids), 0..1; empty without keypoints

  friend bool operator==(const PckCurve&, const PckCurve&) = default;
};
/// Thresholds 0, 1, ... 50 mm. `keypoint_count` includes lost frames.
PckCurve pck_curve(std::span<const double> errors_mm, size_t keypoint_count);

/// From a percentile bootstrap or Student's t.
struct ConfidenceInterval {
  double low = 0;
  double high = 0;
  double level = 0;  ///< 0..1
  int seeds = 0;     ///< resampled
  int blocks = 0;    ///< of successive frames, resampled
  int block_frames = 0;
  /// What was resampled.
  std::string over;

  friend bool operator==(const ConfidenceInterval&, const ConfidenceInterval&) = default;
};

struct BootstrapConfig {
  int block_frames = 15;  ///< >= 1
  int resamples = 2000;   ///< >= 1
  double level = 0.95;    ///< in (0, 1)
  uint64_t seed = 1;
};
/// Interval of the mean over seeds (rows) and frames (columns). Resamples seeds and blocks of frames. Empty for
/// fewer than two blocks, or without values.
std::optional<ConfidenceInterval> confidence_interval(
    const std::vector<std::vector<std::optional<double>>>& values_by_seed, const BootstrapConfig& config = {});

/// A fixed part, such as a trajectory, whose seeds and frames are resampled.
struct StratumShape {
  int seeds = 1;   ///< >= 1
  int frames = 0;  ///< >= 0
};
/// One resample of a stratum.
struct Draw {
  std::vector<int> seeds;
  std::vector<int> frames;
};
/// `statistic` gets one draw per stratum. Empty if `statistic` always is, or for fewer than five blocks in all.
std::optional<ConfidenceInterval> stratified_interval(
    std::span<const StratumShape> strata,
    const std::function<std::optional<double>(std::span<const Draw>)>& statistic,
    const BootstrapConfig& config = {});

/// |T| is below this value with probability `level`, 0..1.
double student_quantile(double level, int degrees_of_freedom);
/// |T| is at least `t` with this probability: the two-sided p-value.
double student_p(double t, int degrees_of_freedom);
/// Holm's step-down method: an adjusted p-value of at most 0.05 is significant at 5% for all hypotheses together.
std::vector<double> holm_adjusted(std::span<const double> p_values);
/// Interval of the mean of independent values. Empty for fewer than five values or equal ones.
std::optional<ConfidenceInterval> student_interval(std::span<const double> values, const std::string& over,
                                                   double level = 0.95);

/// A kilometer in mm.
inline constexpr double kLargestError = 1e6;

nlohmann::ordered_json aggregate_json(const Aggregate& aggregate);
/// Throws: Error unless values are in 0..kLargestError.
Aggregate read_aggregate(const JsonCursor& json);

nlohmann::ordered_json interval_json(const std::optional<ConfidenceInterval>& interval);
/// Throws: Error unless both ends are in min..max.
std::optional<ConfidenceInterval> read_interval(const JsonCursor& json, double min, double max);

}  // namespace glovebench::reports
