#pragma once

#include <array>
#include <span>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// Edge lengths, px.
/// Paper: section III.
inline constexpr std::array<int, 4> kTinySizes = {8, 16, 32, 64};
/// Limits of chamfer_field, px.
inline constexpr int kSmallestTinySize = 4, kLargestTinySize = 64;

/// Half-open ranges, px; may extend beyond the image.
struct Square {
  int left = 0;
  int top = 0;
  int side = 0;
};

/// Around the labeled pixels' bounding box. Side 0 without any.
Square bounding_square(const LabelImage& labels);

/// Unit vector to the center.
Eigen::Vector3d square_ray(const Square& square, const PinholeCamera& camera);

/// Scales the square to size x size. A cell takes its most frequent label; ties go to the glove, then the smaller
/// label.
LabelImage make_tiny_image_plain(const LabelImage& labels, const Square& square, int size);

/// The same, faster.
LabelImage make_tiny_image(const LabelImage& labels, const Square& square, int size);

/// Two labels per byte, the first in the low half.
constexpr size_t packed_bytes(size_t pixels) { return (pixels + 1) / 2; }
/// Labels must be below 16.
void pack_labels(const LabelImage& labels, std::span<uint8_t> packed);
LabelImage unpack_labels(std::span<const uint8_t> packed, int width, int height);

}  // namespace glovebench
