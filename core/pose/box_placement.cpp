#include "core/pose/box_placement.h"

#include <cmath>

namespace glovebench {
namespace {

constexpr int kMaxPlacements = 20;
constexpr double kTolerance_px = 0.01;  // 0.05 mm of depth at arm's length, far below a pixel's resolution
constexpr double kFirstGuess_m = 0.7;   // the middle of the working volume; three steps reach its ends
constexpr double kNearest_m = 1e-3;     // nearer points have no useful projection

}  // namespace

ImageSquare image_square(const Square& square) {
  const double to_middle = 0.5 * (square.side - 1);
  return {{square.left + to_middle, square.top + to_middle}, static_cast<double>(square.side)};
}

std::optional<ImageSquare> projected_square(std::span<const Eigen::Vector3f> points_hand,
                                            const Eigen::Isometry3d& T_camera_hand, const PinholeCamera& camera) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3f& p_hand : points_hand) {
    const Eigen::Vector3d p_camera = T_camera_hand * p_hand.cast<double>();
    if (!(p_camera.z() > kNearest_m)) return std::nullopt;
    box.extend(camera.project(p_camera));
  }
  if (box.isEmpty()) return std::nullopt;
  return ImageSquare{box.center(), box.sizes().maxCoeff()};
}

std::optional<BoxPlacement> place_in_square(std::span<const Eigen::Vector3f> points_hand,
                                            const Eigen::Matrix3d& R_camera_hand, const ImageSquare& observed,
                                            const PinholeCamera& camera) {
  if (!(observed.side_px > 0)) return std::nullopt;
  BoxPlacement result;
  Eigen::Isometry3d& T = result.T_camera_hand;
  T.linear() = R_camera_hand;
  T.translation() = camera.back_project(observed.middle_px.x(), observed.middle_px.y(), kFirstGuess_m);
  while (true) {
    const std::optional<ImageSquare> found = projected_square(points_hand, T, camera);
    if (!found) return std::nullopt;
    const Eigen::Vector2d off_px = observed.middle_px - found->middle_px;
    result.converged =
        off_px.cwiseAbs().maxCoeff() < kTolerance_px && std::abs(observed.side_px - found->side_px) < kTolerance_px;
    if (result.converged || result.iterations == kMaxPlacements) return result;
    // Along the ray of the origin, which leaves the middle nearly where it is, then across.
    T.translation() *= found->side_px / observed.side_px;
    T.translation().x() += off_px.x() / camera.fx * T.translation().z();
    T.translation().y() += off_px.y() / camera.fy * T.translation().z();
    ++result.iterations;
  }
}

}  // namespace glovebench
