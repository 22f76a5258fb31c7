#pragma once

#include <Eigen/Core>

namespace glovebench {

/// Limits of images from files.
inline constexpr int kMostSide_px = 4096;
inline constexpr int kMostPixels = 1 << 21;  // over 1920x1080

/// x right, y down, z forward. Pixel centers are integers: the image spans [-0.5, width - 0.5).
struct PinholeCamera {
  int width = 640;
  int height = 480;
  double fx = 0;  ///< px
  double fy = 0;  ///< px
  double cx = 0;  ///< px
  double cy = 0;  ///< px

  /// Pixel of a point with z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }
  /// `z`: depth, m.
  Eigen::Vector3d back_project(double u_px, double v_px, double z) const {
    return {(u_px - cx) / fx * z, (v_px - cy) / fy * z, z};
  }

  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;
};

/// Brown's model in OpenCV's order.
struct LensDistortion {
  double k1 = 0, k2 = 0;  ///< radial
  double p1 = 0, p2 = 0;  ///< tangential
  double k3 = 0;          ///< radial

  bool is_none() const { return *this == LensDistortion{}; }
  /// From pinhole to lens, in the plane z = 1.
  Eigen::Vector2d distort(const Eigen::Vector2d& xy) const {
    const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  }

  friend bool operator==(const LensDistortion&, const LensDistortion&) = default;
};

}  // namespace glovebench
