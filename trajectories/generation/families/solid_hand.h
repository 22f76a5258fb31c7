#pragma once

#include "core/hand/skeleton.h"

namespace glovebench::trajectories {

/// Largest overlap of capsules around the bones of two fingers, or of a finger and the palm, m. 0 or less: none
/// touch.
double deepest_overlap(const Skeleton& skeleton, const Posture& posture);

}  // namespace glovebench::trajectories
