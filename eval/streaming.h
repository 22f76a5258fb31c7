#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"
#include "reports/study.h"

namespace glovebench::eval {

inline constexpr const char* kStreamingStudy = "streaming";

/// Which frames a live system tracks, and when each answer is finished.
struct Playback {
  std::vector<size_t> kept;         ///< frames that the tracker gets
  std::vector<double> finished_ms;  ///< by kept frame, on the frames' clock

  /// Index in `kept` of the newest finished answer. Empty before the first one.
  std::optional<size_t> in_use(double moment_ms) const;
};
/// Plays frames on a simulated clock. A finished tracker takes the newest frame that arrived meanwhile, else the
/// next. `arrival_ms` increases. `tracker_ms`: time of each frame.
/// Paper: Li, Wang and Ramanan 2020, "Towards Streaming Perception", section 3.
Playback play(std::span<const double> arrival_ms, std::span<const double> tracker_ms);

/// The errors of `runs`, beside those of the answers in use at eight moments a frame; a row per experiment. Runs
/// that drop frames are tracked again without these.
reports::StudyResult streaming_study(Workbench& workbench, const Streaming& streaming,
                                     std::span<const MeasuredRun> runs);

/// Joins the studies of several settings.
reports::StudyResult joined_streaming(const std::vector<std::pair<std::string, reports::StudyResult>>& studies);

}  // namespace glovebench::eval
