#pragma once

#include "core/base/image.h"
#include "render/row_random.h"

namespace glovebench::render {

/// Standard deviation of each 8-bit channel, gray levels.
inline constexpr double kColorSigma_gray = 2.0;

/// Adds Gaussian noise to each channel, rounded and clamped to 0..255.
ColorImage add_color_noise(const ColorImage& color, double sigma_gray, const FrameKey& key);

}  // namespace glovebench::render
