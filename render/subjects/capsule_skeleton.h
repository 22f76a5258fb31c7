#pragma once

#include <cstdint>

#include "core/hand/skeleton.h"
#include "render/subjects/hand_dimensions.h"

namespace glovebench::render {

/// The right hand's skeleton in the hand frame of core/README.md. Index and little MCP at equal height fix +y.
/// `definition` gives the thumb's zero. Tilts each joint by a few random degrees.
Skeleton make_skeleton(const HandDimensions& hand, const Skeleton& definition, uint64_t seed);

}  // namespace glovebench::render
