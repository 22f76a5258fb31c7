#pragma once

#include <Eigen/Core>

namespace glovebench {

/// Images of larger cameras are not read: what a small file says of them would take memory.
inline constexpr int kMostSide_px = 4096;
inline constexpr int kMostPixels = 1 << 21;  // 1920x1080 and a little more

/// A camera without distortion. Axes: x right, y down, z forward. A pixel's center has integer coordinates
/// (OpenCV's convention), so the image spans [-0.5, width - 0.5).
struct PinholeCamera {
  int width = 640;
  int height = 480;
  double fx = 0;  ///< px
  double fy = 0;  ///< px
  double cx = 0;  ///< px
  double cy = 0;  ///< px

  /// uv_px of a point in front of the camera (z > 0).
  Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }
  /// The point at depth z (m, along the optical axis) that is seen at uv_px.
  Eigen::Vector3d back_project(double u_px, double v_px, double z) const {
    return {(u_px - cx) / fx * z, (v_px - cy) / fy * z, z};
  }

  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;
};

}  // namespace glovebench
