#pragma once

#include <Eigen/Core>

#include "core/base/image.h"

namespace glovebench::render {

/// The image of a camera whose white balance has drifted: gains on linear R, G, B (> 0), coded again, cut off at
/// white.
ColorImage with_white_balance(const ColorImage& color, const Eigen::Vector3d& gains);

}  // namespace glovebench::render
