#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/base/image.h"
#include "core/kinect/device.h"

namespace glovebench {

/// Half-open.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};
/// Around the labeled pixels, within the image. Empty without any.
PixelBox label_box(const LabelImage& labels, int margin);

/// Pixels that may show the hand: near ones and those without depth. Others store the offset to the nearest one
/// (Danielsson 1980, to 1 px).
class HandMask {
 public:
  /// `depth`: the frame's, m; may lack what is far. `farthest`: limit of the hand's depth, m.
  void assign(const DepthImage& depth, const DeviceFrame& frame, const PixelBox& box, float farthest);
  /// From a position to the nearest mask pixel, px. Empty within 1 px of it, or without a mask.
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
  RecycledVector<Offset> offsets_;
};

}  // namespace glovebench
