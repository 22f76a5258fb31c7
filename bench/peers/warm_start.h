#pragma once

#include <array>

#include "core/pose/closest_point.h"

namespace glovebench::bench {

/// Starts a search at the point's last face, or at the previous point's of its color.
class WarmStart {
 public:
  /// The point on that face; face -1 without one. `last`: the point's last answer.
  ClosestPoint operator()(const LabeledPoint& point, const ClosestPoint& last, const Surface& surface) const {
    const int face = last.face >= 0 ? last.face : faces_[point.label];
    if (face < 0) return {};
    const Eigen::Vector3f p = closest_on_triangle(point.p, surface.faces(point.label)[face]);
    return {p, (p - point.p).norm(), face};
  }
  void found(const LabeledPoint& point, const ClosestPoint& closest) { faces_[point.label] = closest.face; }

 private:
  std::array<int, kColorCount + 1> faces_ = [] {
    std::array<int, kColorCount + 1> none;
    none.fill(-1);
    return none;
  }();
};

}  // namespace glovebench::bench
