#pragma once

#include <cstdint>

#include "core/hand/skeleton.h"
#include "render/subjects/hand_dimensions.h"

namespace glovebench::render {

/// The right hand's own skeleton. Its hand frame is the one of core/README.md, placed by its own joints: the origin
/// midway between its wrist joint and its middle MCP, -z from the first to the second, and index and little MCP at
/// one height, which fixes +y. Angles mean what they mean in core: zero is a straight finger in line with the palm;
/// the thumb's base is at zero in the orientation that `definition`, the skeleton of the package's mesh, has at
/// zero. Fingers are not quite straight and their flexion axes not quite parallel: each joint is off by a few
/// degrees, which the seed draws and no angle tells.
Skeleton make_skeleton(const HandDimensions& hand, const Skeleton& definition, uint64_t seed);

}  // namespace glovebench::render
