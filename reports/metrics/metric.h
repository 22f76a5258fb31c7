#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/tracker/track_result.h"

namespace glovebench::reports {

struct ExperimentResult;
struct FrameRecord;
struct FrameTruth;
struct MeasuredFrame;

/// What an estimate must have for a metric of tracked frames.
enum class Needs {
  hand,  ///< posture and pose
  posture,
  pose,
  joints,            ///< relative to each other, perhaps without scale
  joints_to_scale,   ///< relative to each other
  joints_in_camera,  ///< in their place
  internals
};

/// One of `of_tracked`, `of_any`, `of_record` and `of_experiment` is given, the others are null. With a gate, less
/// is better. reports/metrics/X_metrics.cpp defines `std::vector<Metric> X_metrics()`.
struct Metric {
  /// Limits for changes of the mean, in the metric's unit.
  struct Gate {
    /// Used without a noise floor.
    double minimum_effect;
    double tolerance;  ///< what another machine can change
  };

  std::string_view key;        ///< in files, with unit: "_mm", "_deg", "_px", "_percent"
  std::string_view unit = {};  ///< for people: "mm", "deg", "px", "%"; empty: 0 to 1
  std::string_view description;
  std::string_view formula = {};  ///< plain text; primes mark the estimate
  std::string_view heading = {};  ///< in the table "More metrics"; empty: not there
  /// Order in files, then by key. Protocol ids depend on it.
  int place = 1000;
  std::optional<Gate> gate = {};  ///< empty: not compared

  std::optional<double> (*of_tracked)(const MeasuredFrame&) = nullptr;  ///< column; empty if lost
  Needs needs = Needs::hand;                                            ///< without it, `of_tracked` has no value
  bool is_partial = false;                                              ///< empty in some tracked frames
  /// Column, also for lost frames.
  std::optional<double> (*of_any)(const TrackResult&, const FrameTruth&) = nullptr;
  /// Share of frames with a value; no column.
  std::optional<bool> (*of_record)(const FrameRecord&) = nullptr;
  std::string_view of_column = {};  ///< column that `of_record` needs
  /// Over all frames and seeds; no column.
  std::optional<double> (*of_experiment)(const ExperimentResult&) = nullptr;
  std::string_view over = {};  ///< of `of_experiment`: see averaged_over
  int digits = 2;              ///< of `of_experiment`, for people

  bool is_share() const { return of_record != nullptr; }
  bool is_column() const { return of_tracked || of_any; }
  /// The frames that count, and how lost ones count.
  std::string_view averaged_over() const;
};

/// All metrics, by place.
std::span<const Metric> metrics();
/// Columns, in the order of FrameRecord::values.
std::span<const Metric> frame_metrics();
std::vector<std::string> frame_metric_keys();
std::span<const Metric> gated_metrics();

/// Null for an unknown key.
const Metric* find_metric(std::string_view key);
/// An unknown key is a broken invariant.
const Metric& metric_of(std::string_view key);
/// Index in frame_metrics().
/// Throws: std::logic_error for an unknown key.
size_t metric_index(std::string_view key);
/// Empty for an unknown key.
std::optional<size_t> find_frame_metric(std::string_view key);

/// 100 or 0 for a share. Empty without value.
std::optional<double> value_of(const Metric& metric, const FrameRecord& frame);
/// Of a column: the mean over frames. A share is a broken invariant.
std::optional<double> value_of(const Metric& metric, const ExperimentResult& experiment);

}  // namespace glovebench::reports
