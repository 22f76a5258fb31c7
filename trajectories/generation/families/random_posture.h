#pragma once

#include "core/base/random.h"
#include "core/hand/posture.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::trajectories {

/// A random posture within limits and `bend`. MCP and PIP flexions of index to little are uniform and correlate
/// with neighbors by kNeighborCorrelation. DIP is a uniform share of PIP (kDipShare). Thumb and wrist are uniform.
/// Parts may overlap, and a gesture may be near.
Posture random_posture(const MovementFamily& family, const Range& bend, RandomStream& random);

}  // namespace glovebench::trajectories
