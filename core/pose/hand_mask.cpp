#include "core/pose/hand_mask.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/image.h"
#include "core/kinect/disparity.h"

namespace glovebench {
namespace {

constexpr int16_t kNoMask_px = 8192;  ///< farther than any pixel: a column without the mask counts on from here

}  // namespace

PixelBox label_box(const LabelImage& labels, int margin) {
  PixelBox box{labels.width(), labels.height(), 0, 0};
  for (int v = 0; v < labels.height(); ++v) {
    for_each_nonzero(labels, v, [&](int u) {
      box.left = std::min(box.left, u);
      box.right = std::max(box.right, u + 1);
      box.top = std::min(box.top, v);
      box.bottom = v + 1;
    });
  }
  if (box.right == 0) return {};
  return {std::max(0, box.left - margin), std::max(0, box.top - margin),
          std::min(labels.width(), box.right + margin), std::min(labels.height(), box.bottom + margin)};
}

void HandMask::assign(const DepthImage& depth, const Image<uint16_t>& raw_disparity, const PixelBox& box,
                      float farthest) {
  check(depth.width() == raw_disparity.width() && depth.height() == raw_disparity.height(),
        "depth and disparity are images of one camera");
  box_ = box;
  width_ = box.right - box.left;
  height_ = box.bottom - box.top;
  bool is_empty = true;
  below_.resize(static_cast<size_t>(width_) * height_);
  next_.assign(width_, static_cast<int16_t>(-kNoMask_px));
  // Downward, with the way up to the last pixel of the mask; then upward, with the way down, if that is shorter.
  for (int v = 0; v < height_; ++v) {
    const float* const z = depth.row(box.top + v) + box.left;
    const uint16_t* const raw = raw_disparity.row(box.top + v) + box.left;
    int16_t* const below = below_.data() + static_cast<size_t>(v) * width_;
    for (int u = 0; u < width_; ++u) {
      const bool may_be_hand = (raw[u] == kNoDisparity) | ((z[u] > 0) & (z[u] < farthest));
      next_[u] = may_be_hand ? int16_t{0} : static_cast<int16_t>(next_[u] - 1);
      below[u] = next_[u];
      is_empty &= !may_be_hand;
    }
  }
  is_empty_ = is_empty;
  std::ranges::fill(next_, kNoMask_px);
  for (int v = height_ - 1; v >= 0; --v) {
    int16_t* const below = below_.data() + static_cast<size_t>(v) * width_;
    for (int u = 0; u < width_; ++u) {
      next_[u] = below[u] == 0 ? int16_t{0} : static_cast<int16_t>(next_[u] + 1);
      if (next_[u] < -below[u]) below[u] = next_[u];
    }
  }
}

std::optional<Eigen::Vector2d> HandMask::way_back_px(const Eigen::Vector2d& uv_px) const {
  if (is_empty_) return {};
  // The nearest pixel. Rounding toward zero does no harm: what is negative comes into the box anyway.
  const int u = std::clamp(static_cast<int>(uv_px.x() + 0.5), box_.left, box_.right - 1);
  const int v = std::clamp(static_cast<int>(uv_px.y() + 0.5), box_.top, box_.bottom - 1);
  const int16_t* const below = below_.data() + static_cast<size_t>(v - box_.top) * width_;
  const int column = u - box_.left;
  int du = 0, squared = below[column] * below[column];
  for (int d = 1; d < width_ && d * d < squared; ++d) {
    for (const int other : {-d, d}) {
      if (column + other < 0 || column + other >= width_) continue;
      const int dv = below[column + other];
      if (d * d + dv * dv >= squared) continue;
      du = other;
      squared = d * d + dv * dv;
    }
  }
  const Eigen::Vector2d way = Eigen::Vector2d(u + du, v + below[column + du]) - uv_px;
  if (way.squaredNorm() <= 1) return {};
  return way;
}

}  // namespace glovebench
