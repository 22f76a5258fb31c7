#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// Pixels from `left`, `top` to before `right`, `bottom`.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};
/// Around the labeled pixels, with a margin, within the image; empty if there are none.
PixelBox label_box(const LabelImage& labels, int margin);

/// Pixels at which the hand may be: those that are near enough, and those without a depth. Every pixel of the box
/// stores its way to the nearest of those in its column; the nearest of all is found among these when it is asked
/// for.
class HandMask {
 public:
  /// `depth` and `raw_disparity` are of one camera; the hand is nearer than `farthest` (m). Keeps its memory.
  void assign(const DepthImage& depth, const Image<uint16_t>& raw_disparity, const PixelBox& box, float farthest);
  /// From a place in the image to the nearest pixel of the mask, px, if that is farther than a pixel away. Nothing
  /// in a box without such pixels.
  std::optional<Eigen::Vector2d> way_back_px(const Eigen::Vector2d& uv_px) const;

 private:
  PixelBox box_;
  int width_ = 0, height_ = 0;
  bool is_empty_ = true;
  RecycledVector<int16_t> below_;  ///< rows down to the nearest pixel of the mask in the column; negative: up
  RecycledVector<int16_t> next_;   ///< reused by `assign`: the same, of the row below, downward only
};

}  // namespace glovebench
