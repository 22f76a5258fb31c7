#pragma once

#include "core/hand/rigged_mesh.h"

namespace glovebench {

/// Cuts the flat cap off the wrist end of a mesh in the hand frame, extrudes `length` metres of forearm from the
/// opening, closes it, adds the forearm joint at the wrist and blends its weight in over +-12 mm around it.
RiggedMesh with_forearm(const RiggedMesh& hand, double length);

}  // namespace glovebench
