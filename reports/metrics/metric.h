#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/tracker/track_result.h"

namespace glovebench::reports {

struct FrameRecord;
struct MeasuredFrame;

/// A number for each frame of a run; less is better. Exactly one of `of_tracked`, `of_any` and `of_record` is set.
/// reports/metrics/X_metrics.cpp defines `std::vector<Metric> X_metrics()`.
struct Metric {
  /// Changes of the mean, in the metric's unit.
  struct Gate {
    /// The least that matters where no noise floor was measured. Today's are about a fifteenth of the means of
    /// Figure 4: what a reader of its table would notice.
    double minimum_effect;
    double tolerance;  ///< what another machine may change
  };

  std::string_view key;   ///< in files; ends in its unit: "_mm", "_deg", "_px", "_percent"
  std::string_view unit;  ///< in tables: "mm", "deg", "px", "%"
  std::string_view description;
  std::string_view heading = {};  ///< of its mean in the table "More metrics"; empty: not there
  /// Order in files; equal places by key. The ids of protocols depend on it: keep the places of old metrics.
  int place = 1000;
  std::optional<Gate> gate = {};  ///< empty: not compared

  std::optional<double> (*of_tracked)(const MeasuredFrame&) = nullptr;  ///< a column; empty in lost frames
  bool is_partial = false;                                              ///< empty in some tracked frames, too
  std::optional<double> (*of_any)(const TrackResult&) = nullptr;        ///< a column, also in lost frames
  bool (*of_record)(const FrameRecord&) = nullptr;                      ///< a share of all frames; no column

  bool is_share() const { return of_record != nullptr; }
};

/// All metrics, by place.
std::span<const Metric> metrics();
/// Those that are columns of frames: FrameRecord::values has their order.
std::span<const Metric> frame_metrics();
std::vector<std::string> frame_metric_keys();
/// Those that comparisons and the gate look at.
std::span<const Metric> gated_metrics();

/// An unknown key is a broken invariant.
const Metric& metric_of(std::string_view key);
/// Index in frame_metrics(); an unknown key is a broken invariant.
size_t metric_index(std::string_view key);
/// The same; empty for an unknown key, since a file may hold the metrics of another version.
std::optional<size_t> find_frame_metric(std::string_view key);

/// The value of one frame: 100 or 0 for a share, empty if the frame has none.
std::optional<double> value_of(const Metric& metric, const FrameRecord& frame);

}  // namespace glovebench::reports
