#pragma once

#include "core/base/random.h"
#include "core/hand/posture.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::trajectories {

/// A random posture within the limits, bent within `bend`. The MCP and PIP flexions of index to little are uniform,
/// those of neighbors correlate by kNeighborCorrelation; DIP is a uniform share of PIP within kDipShare; thumb and
/// wrist are uniform. It may pierce itself and be near a gesture.
Posture random_posture(const MovementFamily& family, const Range& bend, RandomStream& random);

}  // namespace glovebench::trajectories
