#pragma once

#include "core/hand/skeleton.h"

namespace glovebench::trajectories {

/// Deepest overlap, m, of capsules around the bones of different fingers, or of a finger and the palm. 0 or less:
/// none touch. A person's flesh yields by about kMostOverlap.
double deepest_overlap(const Skeleton& skeleton, const Posture& posture);

}  // namespace glovebench::trajectories
