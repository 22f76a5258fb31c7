#include "reports/metrics/visibility.h"

#include "reports/metrics/coverage.h"

namespace glovebench::reports {
namespace {

bool is_in_image(const PinholeCamera& camera, const Eigen::Vector3d& p_camera) {
  if (p_camera.z() <= 0) return false;
  const Eigen::Vector2d uv_px = camera.project(p_camera);
  return uv_px.x() >= -0.5 && uv_px.x() < camera.width - 0.5 && uv_px.y() >= -0.5 &&
         uv_px.y() < camera.height - 0.5;
}

}  // namespace

double visible_percent(const PosedHand& hand, std::span<const Triangle> triangles,
                       const Eigen::Isometry3d& T_camera_hand, const RgbdCalibration& calibration) {
  double facing = 0, visible = 0;
  for (const Triangle& triangle : triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for (size_t i = 0; i < 3; ++i) p[i] = T_camera_hand * hand.vertices[triangle.vertices[i]].cast<double>();
    const Eigen::Vector3d centroid = (p[0] + p[1] + p[2]) / 3;
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);  // twice the area long
    if (normal.dot(centroid) >= 0) continue;
    facing += normal.norm();
    const double z_mm = 1000 * centroid.z();
    if (z_mm >= kVolumeNear_mm && z_mm <= kVolumeFar_mm && is_in_image(calibration.ir, centroid) &&
        is_in_image(calibration.rgb, calibration.T_rgb_ir * centroid))
      visible += normal.norm();
  }
  return facing > 0 ? 100 * visible / facing : 0;
}

}  // namespace glovebench::reports
