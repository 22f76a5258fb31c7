#pragma once

#include <cstdint>

#include "core/base/image.h"

namespace glovebench {

/// Interpolates colors from a Kinect's mosaic, in squares of
///
///     green red
///     blue  green
///
/// A missing color is the mean of its neighbors in the image, rounded.
/// Throws: Error unless the sides are even and at least 2 px.
ColorImage color_from_bayer(const Image<uint8_t>& mosaic);

/// The mosaic of a color image.
/// Throws: Error, as `color_from_bayer`.
Image<uint8_t> bayer_from_color(const ColorImage& color);

}  // namespace glovebench
