#include "core/database/view_sphere.h"

#include <Eigen/Geometry>
#include <array>
#include <numbers>

#include "core/base/error.h"

namespace glovebench {
namespace {

std::array<Eigen::Vector3d, 12> icosahedron() {
  const double phi = std::numbers::phi;
  std::array<Eigen::Vector3d, 12> corners;
  int i = 0;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-phi, phi}) {
      corners[i++] = {0, s, t};
      corners[i++] = {s, t, 0};
      corners[i++] = {t, 0, s};
    }
  }
  for (Eigen::Vector3d& c : corners) c.normalize();
  return corners;
}

/// A camera at `direction` from the hand that looks at it; the fingers (-z of the hand) point up in the image
/// where that is defined.
Eigen::Matrix3d look_at_hand(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d forward = -direction;
  const Eigen::Vector3d down_hint =
      std::abs(forward.z()) < 0.99 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d right = down_hint.cross(forward).normalized();
  Eigen::Matrix3d R_view_hand;
  R_view_hand << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return R_view_hand;
}

}  // namespace

std::vector<Eigen::Vector3d> camera_directions() {
  const std::array<Eigen::Vector3d, 12> corners = icosahedron();
  std::vector<Eigen::Vector3d> directions(corners.begin(), corners.end());
  double shortest = 2;
  for (size_t i = 0; i < corners.size(); ++i)
    for (size_t j = i + 1; j < corners.size(); ++j) shortest = std::min(shortest, (corners[i] - corners[j]).norm());
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = i + 1; j < corners.size(); ++j)
      if ((corners[i] - corners[j]).norm() < 1.01 * shortest)
        directions.push_back((corners[i] + corners[j]).normalized());
  }
  check(directions.size() == kCameraPositions, "an icosahedron has 12 corners and 30 edges");
  return directions;
}

const std::vector<Eigen::Matrix3d>& view_rotations() {
  static const std::vector<Eigen::Matrix3d> rotations = [] {
    std::vector<Eigen::Matrix3d> result;
    for (const Eigen::Vector3d& direction : camera_directions()) {
      for (int r = 0; r < kInPlaneRotations; ++r) {
        const double angle = 2 * std::numbers::pi * r / kInPlaneRotations;
        result.push_back(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                         look_at_hand(direction));
      }
    }
    return result;
  }();
  return rotations;
}

}  // namespace glovebench
