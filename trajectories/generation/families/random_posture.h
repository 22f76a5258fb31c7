#pragma once

#include "core/base/random.h"
#include "core/hand/posture.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::trajectories {

/// Within limits and `bend`. MCP and PIP flexions are uniform and correlated (kNeighborCorrelation). DIP is a
/// share of PIP (kDipShare). Parts may overlap, and a gesture may be near.
Posture random_posture(const MovementFamily& family, const Range& bend, RandomStream& random);

}  // namespace glovebench::trajectories
