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

/// Pixels at which the hand may be: those that are near enough, and those without a depth. Every other pixel of the
/// box stores its way to the nearest of those (Danielsson 1980, sequential Euclidean mapping: off by at most a
/// pixel).
class HandMask {
 public:
  /// `depth` and `raw_disparity` are of one camera; the hand is nearer than `farthest` (m). Keeps its memory.
  void assign(const DepthImage& depth, const Image<uint16_t>& raw_disparity, const PixelBox& box, float farthest);
  /// From a place in the image to the nearest pixel of the mask, px, if that is farther than a pixel away. Nothing
  /// in a box without such pixels.
  std::optional<Eigen::Vector2d> way_back_px(const Eigen::Vector2d& uv_px) const;

 private:
  struct Offset {
    int16_t du, dv;
    int squared() const { return du * du + dv * dv; }
  };
  Offset* row(int v) { return offsets_.data() + static_cast<size_t>(v) * width_; }
  void sweep(int v, int dv);

  PixelBox box_;
  int width_ = 0, height_ = 0;
  bool is_empty_ = true;
  RecycledVector<Offset> offsets_;  ///< to the nearest pixel of the mask
};

}  // namespace glovebench
