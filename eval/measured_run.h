#pragma once

#include <span>
#include <vector>

#include "core/hand/posture.h"
#include "core/tracker/track_result.h"
#include "eval/run.h"
#include "reports/metrics/measure_frame.h"
#include "reports/results.h"

namespace glovebench::eval {

struct MeasuredRun {
  Run run;
  std::vector<reports::FrameErrors> errors;  ///< by frame
};

/// `subject`: the rendered hand.
std::vector<reports::FrameErrors> measure(const Run& run, const HandModel& tracker_hand,
                                          const render::Subject& subject);
/// Measures on the workbench's threads, in the order of `runs`.
std::vector<MeasuredRun> measure(Workbench& workbench, std::vector<Run> runs);

/// Jitter and latency, as `glovebench list metrics` defines them. Latency needs 30 frames. At rest
/// the posture also changes by less than 0.5 deg per frame. `estimates`: one per frame of `truth`.
reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates, std::span<const HandFrame> truth);

}  // namespace glovebench::eval
