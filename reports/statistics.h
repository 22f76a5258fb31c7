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

// Statistics of plain numbers. An empty set has none: the result is an empty optional, never 0 or NaN. A value that
// is not finite is a bug of whoever measured it: every function here throws std::logic_error on one.

std::optional<double> mean(std::span<const double> values);
/// Root mean square.
std::optional<double> rms(std::span<const double> values);
/// The value below which a share of 0..1 lies, by linear interpolation between order statistics (rank
/// share * (n - 1)); 0.5 is the median.
std::optional<double> percentile(std::span<const double> values, double share);

/// A metric over frames, in the metric's own unit. All values are empty when count is 0.
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

/// Share of keypoints whose error is at most each threshold (PCK), and the area under that curve by the
/// trapezoidal rule, divided by its width, so 0..1.
struct PckCurve {
  std::vector<double> thresholds_mm;
  std::vector<double> shares;
  std::optional<double> area;  ///< empty when there are no keypoints

  friend bool operator==(const PckCurve&, const PckCurve&) = default;
};
/// Thresholds 0, 1, ... 50 mm. `keypoint_count` counts all keypoints, those of lost frames (which have no error)
/// included: they stay in the denominator. At least as many as errors.
PckCurve pck_curve(std::span<const double> errors_mm, size_t keypoint_count);

/// A percentile bootstrap interval of a mean.
struct ConfidenceInterval {
  double low = 0;
  double high = 0;
  double level = 0;      ///< share of resampled means inside, e.g. 0.95
  int seeds = 0;         ///< noise seeds that were resampled
  int blocks = 0;        ///< blocks of consecutive frames that were resampled
  int block_frames = 0;  ///< frames in a block
  /// What the interval is over, in words: it says nothing about what was not resampled.
  std::string over;

  friend bool operator==(const ConfidenceInterval&, const ConfidenceInterval&) = default;
};

struct BootstrapConfig {
  int block_frames = 15;  ///< frames of one block: successive frames are not independent, >= 1
  int resamples = 2000;   ///< >= 1
  double level = 0.95;    ///< in (0, 1)
  uint64_t seed = 1;
};
/// Interval of the mean over seeds (rows) and frames (columns; no value where a frame is lost). Noise seeds and
/// blocks of frames are drawn again with replacement, both at once, since the seeds share the movement. Empty when
/// there are fewer than two blocks or no values.
std::optional<ConfidenceInterval> confidence_interval(
    const std::vector<std::vector<std::optional<double>>>& values_by_seed, const BootstrapConfig& config = {});

/// A fixed part of what is measured, e.g. a trajectory: seeds (rows) and frames (columns) that can be drawn again.
struct StratumShape {
  int seeds = 1;   ///< >= 1
  int frames = 0;  ///< >= 0
};
/// One resample of a stratum: its seeds and its frames, some of them repeated, others missing.
struct Draw {
  std::vector<int> seeds;
  std::vector<int> frames;
};
/// Interval of any statistic over fixed strata: in each, noise seeds and blocks of frames are drawn again, with
/// replacement. `statistic` gets one draw a stratum, in their order, and may have no value. Empty when it never has
/// one, or when fewer than five blocks can be drawn in all.
std::optional<ConfidenceInterval> stratified_interval(
    std::span<const StratumShape> strata,
    const std::function<std::optional<double>(std::span<const Draw>)>& statistic,
    const BootstrapConfig& config = {});

/// No error is larger (a kilometre, in mm), so that sums and squares of what a file holds stay finite.
inline constexpr double kLargestError = 1e6;

/// An aggregate as every report writes it, without an interval.
nlohmann::ordered_json aggregate_json(const Aggregate& aggregate);
/// Reads the members back, whatever others there are; throws Error unless values lie in 0..kLargestError.
Aggregate read_aggregate(const JsonCursor& json);

/// An interval as every report writes it; null for none.
nlohmann::ordered_json interval_json(const std::optional<ConfidenceInterval>& interval);
/// Reads it back; throws Error unless both ends lie in min..max.
std::optional<ConfidenceInterval> read_interval(const JsonCursor& json, double min, double max);

}  // namespace glovebench::reports
