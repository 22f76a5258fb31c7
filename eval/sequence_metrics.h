#pragma once

#include <span>

#include "core/tracker/track_result.h"
#include "reports/results.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// Jitter: root mean square change of the position and rotation error between frames, while the truth is at rest
/// (under 1 mm, 0.5 degrees and 0.5 degrees of posture a frame). Latency: the delay of the posture (0..10 frames,
/// parabola through the best three) that agrees best with the truth; only if the truth's posture moves, over at
/// least 30 frames. Both skip lost frames.
reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates, std::span<const HandFrame> truth);

}  // namespace glovebench::eval
