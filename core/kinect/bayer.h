#pragma once

#include <cstdint>

#include "core/base/image.h"

namespace glovebench {

/// A Kinect v1 color image as its sensor takes it: one color a pixel, in squares of
///
///     green red
///     blue  green
///
/// The two colors that a pixel lacks are the means of its neighbors (bilinear, rounded to the nearest); at the
/// border of those that there are. Sides are even and at least 2 px: throws Error otherwise.
ColorImage color_from_bayer(const Image<uint8_t>& mosaic);

/// What the sensor would have taken: of each pixel the one color. Throws Error as above.
Image<uint8_t> bayer_from_color(const ColorImage& color);

}  // namespace glovebench
