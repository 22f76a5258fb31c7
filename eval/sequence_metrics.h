#pragma once

#include <span>

#include "core/tracker/track_result.h"
#include "reports/results.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// Jitter: RMS change of the pose error between frames while the truth rests (under 1 mm, 0.5 deg, and 0.5 deg of
/// posture a frame; at least 10 steps). Latency: the delay, 0..10 frames, at which the posture fits a moving truth
/// best (parabola through three; at least 30 frames). Skips lost frames.
reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates, std::span<const HandFrame> truth);

}  // namespace glovebench::eval
