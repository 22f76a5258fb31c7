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

/// A number per frame or per experiment; of those with a gate, less is better. Exactly one of `of_tracked`,
/// `of_any`, `of_record` and `of_experiment` is set. reports/metrics/X_metrics.cpp defines `std::vector<Metric>
/// X_metrics()`.
struct Metric {
  /// For changes of the mean, in the metric's unit.
  struct Gate {
    /// Default without a noise floor: about 1/15 of Figure 4's means.
    double minimum_effect;
    double tolerance;  ///< possible change by another machine
  };

  std::string_view key;        ///< in files, with unit: "_mm", "_deg", "_px", "_percent"
  std::string_view unit = {};  ///< for people: "mm", "deg", "px", "%"; empty: 0 to 1
  std::string_view description;
  std::string_view formula = {};  ///< plain text; primes mark the estimate
  std::string_view heading = {};  ///< in the table "More metrics"; empty: not there
  /// Order in files, then by key. Protocol ids depend on it, so keep old places.
  int place = 1000;
  std::optional<Gate> gate = {};  ///< empty: not compared

  std::optional<double> (*of_tracked)(const MeasuredFrame&) = nullptr;  ///< column; empty in lost frames
  bool is_partial = false;                                              ///< also empty in some tracked frames
  /// Column, also in lost frames.
  std::optional<double> (*of_any)(const TrackResult&, const FrameTruth&) = nullptr;
  /// Share of the frames that have a value; no column.
  std::optional<bool> (*of_record)(const FrameRecord&) = nullptr;
  std::string_view of_column = {};  ///< of a share: the column without which no frame has an answer
  /// Over all frames and seeds; no column.
  std::optional<double> (*of_experiment)(const ExperimentResult&) = nullptr;
  std::string_view over = {};  ///< with `of_experiment`: what it is taken over, and what becomes of lost frames
  int digits = 2;              ///< with `of_experiment`: for people

  bool is_share() const { return of_record != nullptr; }
  bool is_column() const { return of_tracked || of_any; }
  /// The frames over which the mean is taken (for `of_experiment`: `over`), and what becomes of lost ones.
  std::string_view averaged_over() const;
};

/// All metrics, by place.
std::span<const Metric> metrics();
/// Columns of frames, in the order of FrameRecord::values.
std::span<const Metric> frame_metrics();
std::vector<std::string> frame_metric_keys();
/// Those of comparisons and the gate.
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

/// 100 or 0 for a share. Empty if the frame has no value.
std::optional<double> value_of(const Metric& metric, const FrameRecord& frame);
/// Of a column: the mean of the frames. A share is a broken invariant.
std::optional<double> value_of(const Metric& metric, const ExperimentResult& experiment);

}  // namespace glovebench::reports
