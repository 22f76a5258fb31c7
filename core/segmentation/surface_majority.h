#pragma once

#include "core/base/image.h"

namespace glovebench {

/// Labels where patches meet and where the hand ends: there a pixel mixes two colors, and a color table says
/// nothing of it, or a third color (not in the paper). Each pixel with a depth takes the label that most of its 3x3
/// neighborhood has, itself included, of those within `depth_step` (m) of its depth; pixels without a label do not
/// vote, its own label wins a tie, else the smallest. A pixel that has none takes one only if two vote. Both images
/// have one size.
LabelImage surface_majority(const LabelImage& labels, const DepthImage& depth, double depth_step = 0.02);

}  // namespace glovebench
