#pragma once

#include <array>
#include <span>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// Edge lengths of the tiny images, px (section III).
inline constexpr std::array<int, 4> kTinySizes = {8, 16, 32, 64};
/// What a database may have, px. Larger images do not fit: chamfer_field steps at most 64 px along a row, and a
/// stored distance is a byte, also when the cap is the whole side. Smaller ones tell nothing.
inline constexpr int kSmallestTinySize = 4, kLargestTinySize = 64;

/// A square in an image: half-open pixel ranges, may reach beyond the image.
struct Square {
  int left = 0;
  int top = 0;
  int side = 0;
};

/// The square around the bounding box of all labeled pixels, centered on it; side 0 if there are none.
Square bounding_square(const LabelImage& labels);

/// Direction from the camera through the middle of a square, unit length.
Eigen::Vector3d square_ray(const Square& square, const PinholeCamera& camera);

/// The square scaled to size x size: each cell takes the label that the most pixels under it have (0 counts;
/// ties go to the glove, then to the smaller label). A cell covers the pixels from floor to ceil of its edges: at
/// least one, also where the square is smaller than the tiny image. Pixel after pixel.
LabelImage make_tiny_image_plain(const LabelImage& labels, const Square& square, int size);

/// The same image, faster: a row of cells counts the votes of its pixel columns, and each cell adds up its columns.
LabelImage make_tiny_image(const LabelImage& labels, const Square& square, int size);

/// Labels at 4 bits a pixel: two pixels a byte, the earlier one in its low half.
constexpr size_t packed_bytes(size_t pixels) {
  return (pixels + 1) / 2;
}
/// `packed` has `packed_bytes` of the image's pixels; every label is below 16.
void pack_labels(const LabelImage& labels, std::span<uint8_t> packed);
LabelImage unpack_labels(std::span<const uint8_t> packed, int width, int height);

}  // namespace glovebench
