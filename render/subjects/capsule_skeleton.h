#pragma once

#include <cstdint>

#include "core/hand/skeleton.h"
#include "render/subjects/hand_dimensions.h"

namespace glovebench::render {

/// Right hand (render/README.md). `definition` gives the thumb's zero. The seed tilts the joints.
Skeleton make_skeleton(const HandDimensions& hand, const Skeleton& definition, uint64_t seed);

}  // namespace glovebench::render
