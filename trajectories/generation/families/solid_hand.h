#pragma once

#include "core/hand/skeleton.h"

namespace glovebench::trajectories {

/// How deep parts of the hand reach into each other in this posture, m: the deepest pair of capsules around the
/// bones of different fingers, or of a finger and the palm. 0 or less: none touch. A person's flesh yields by
/// kMostOverlap or so.
double deepest_overlap(const Skeleton& skeleton, const Posture& posture);

}  // namespace glovebench::trajectories
