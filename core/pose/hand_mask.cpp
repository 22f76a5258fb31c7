#include "core/pose/hand_mask.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/image.h"
#include "core/kinect/disparity.h"

namespace glovebench {
namespace {

constexpr int16_t kNoMask_px = 8192;  ///< farther than any pixel, and its square fits

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

/// Updates a row: from the row before it in the direction of the sweep, then from the left, then from the right.
void HandMask::sweep(int v, int dv) {
  Offset* const here = row(v);
  const auto learn = [](Offset& mine, Offset theirs, int du, int dv_step) {
    theirs.du = static_cast<int16_t>(theirs.du + du);
    theirs.dv = static_cast<int16_t>(theirs.dv + dv_step);
    if (theirs.squared() < mine.squared()) mine = theirs;
  };
  if (v + dv >= 0 && v + dv < height_)
    for (int u = 0; u < width_; ++u) learn(here[u], row(v + dv)[u], 0, dv);
  for (int u = 1; u < width_; ++u) learn(here[u], here[u - 1], -1, 0);
  for (int u = width_ - 2; u >= 0; --u) learn(here[u], here[u + 1], 1, 0);
}

void HandMask::assign(const DepthImage& depth, const DeviceFrame& frame, const PixelBox& box, float farthest) {
  const bool is_disparity = !frame.raw_disparity.empty();
  check(depth.size() == (is_disparity ? frame.raw_disparity.size() : frame.depth.size()),
        "both depths are images of one camera");
  box_ = box;
  width_ = box.right - box.left;
  height_ = box.bottom - box.top;
  is_empty_ = true;
  offsets_.resize(static_cast<size_t>(width_) * height_);
  for (int v = 0; v < height_; ++v) {
    const float* const z = depth.row(box.top + v) + box.left;
    const uint16_t* const raw = is_disparity ? frame.raw_disparity.row(box.top + v) + box.left : nullptr;
    const float* const measured = is_disparity ? nullptr : frame.depth.row(box.top + v) + box.left;
    for (int u = 0; u < width_; ++u) {
      const bool is_unmeasured = is_disparity ? raw[u] == kNoDisparity : !(measured[u] > 0);
      const bool may_be_hand = is_unmeasured || (z[u] > 0 && z[u] < farthest);
      row(v)[u] = may_be_hand ? Offset{0, 0} : Offset{kNoMask_px, kNoMask_px};
      is_empty_ &= !may_be_hand;
    }
  }
  for (int v = 0; v < height_; ++v) sweep(v, -1);
  for (int v = height_ - 1; v >= 0; --v) sweep(v, 1);
}

std::optional<Eigen::Vector2d> HandMask::way_back_px(const Eigen::Vector2d& uv_px) const {
  if (is_empty_) return {};
  const int u = std::clamp(static_cast<int>(uv_px.x() + 0.5), box_.left, box_.right - 1);
  const int v = std::clamp(static_cast<int>(uv_px.y() + 0.5), box_.top, box_.bottom - 1);
  const Offset& offset = offsets_[static_cast<size_t>(v - box_.top) * width_ + (u - box_.left)];
  const Eigen::Vector2d way = Eigen::Vector2d(u + offset.du, v + offset.dv) - uv_px;
  if (way.squaredNorm() <= 1) return {};
  return way;
}

}  // namespace glovebench
