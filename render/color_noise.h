#pragma once

#include "core/base/image.h"
#include "render/row_random.h"

namespace glovebench::render {

/// Standard deviation of each 8-bit channel.
inline constexpr double kColorSigma_gray = 2.0;

ColorImage add_color_noise(const ColorImage& color, double sigma_gray, const FrameKey& key);

}  // namespace glovebench::render
