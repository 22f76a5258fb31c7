#include "core/tracker/hand_view.h"

#include <algorithm>
#include <cmath>

namespace glovebench {
namespace {

constexpr float kDepthStep = 0.010;  ///< m: a point beside a larger one lies on an edge and may be anywhere
constexpr float kBehindHand = 0.13;  ///< m: what is this much farther than the hand's mean depth is not the hand
constexpr int kMaskMargin_px = 40;

/// Does a neighbor of a pixel within the image lie at another depth, or at none?
bool is_at_edge(const DepthImage& depth, int u, int v) {
  if (u == 0 || v == 0 || u + 1 == depth.width() || v + 1 == depth.height()) return true;
  const float z = depth(u, v);
  const float farthest = std::max(std::max(std::abs(depth(u - 1, v) - z), std::abs(depth(u + 1, v) - z)),
                                  std::max(std::abs(depth(u, v - 1) - z), std::abs(depth(u, v + 1) - z)));
  return farthest > kDepthStep;
}

float mean_depth(std::span<const LabeledPoint> points) {
  double sum = 0;
  for (const LabeledPoint& point : points) sum += point.p.z();
  return static_cast<float>(sum / static_cast<double>(points.size()));
}

}  // namespace

void HandView::assign(const Sighting& seen, const DeviceFrame& frame) {
  const LabeledCloud& cloud = seen.cloud;
  mask.assign(seen.depth, frame, label_box(cloud.labels, kMaskMargin_px), mean_depth(cloud.points) + kBehindHand);
  points.clear();
  points.reserve(cloud.points.size());
  size_t next = 0;
  for (int v = 0; v < seen.depth.height(); ++v) {
    for (int u = 0; u < seen.depth.width(); ++u) {
      if (cloud.labels(u, v) == 0) continue;
      const LabeledPoint& point = cloud.points[next++];
      if (!is_at_edge(seen.depth, u, v)) points.push_back(point);
    }
  }
}

}  // namespace glovebench
