#pragma once

#include "core/hand/skeleton.h"

namespace glovebench::trajectories {

/// Overlap of capsules around the bones of different fingers, or of a finger and the palm, m. 0 or less: none
/// touch. Flesh yields by about kMostOverlap.
double deepest_overlap(const Skeleton& skeleton, const Posture& posture);

}  // namespace glovebench::trajectories
