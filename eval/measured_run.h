#pragma once

#include <span>
#include <vector>

#include "core/tracker/track_result.h"
#include "eval/run.h"
#include "reports/metrics/measure_frame.h"
#include "reports/results.h"
#include "trajectories/trajectory.h"

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

/// Jitter: RMS change of the pose error between frames while the truth rests (under 1 mm, 0.5 deg, and 0.5 deg of
/// posture per frame; at least 10 steps). Latency: the delay, 0..10 frames, at which the posture fits a moving
/// truth best (parabola through three; at least 30 frames). Skips lost frames.
reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates, std::span<const HandFrame> truth);

}  // namespace glovebench::eval
