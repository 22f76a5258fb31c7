#pragma once

#include <Eigen/Core>

namespace glovebench {

/// How a lens departs from a pinhole (Brown's model with OpenCV's names and order).
struct LensDistortion {
  double k1 = 0, k2 = 0;  ///< radial
  double p1 = 0, p2 = 0;  ///< tangential
  double k3 = 0;          ///< radial

  bool is_none() const { return *this == LensDistortion{}; }
  /// Where the lens puts what a pinhole would put at xy = (x / z, y / z).
  Eigen::Vector2d distort(const Eigen::Vector2d& xy) const {
    const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  }

  friend bool operator==(const LensDistortion&, const LensDistortion&) = default;
};

}  // namespace glovebench
