#pragma once

#include <Eigen/Geometry>
#include <numbers>

namespace glovebench {

constexpr double radians_from_degrees(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
constexpr double degrees_from_radians(double radians) {
  return radians * 180.0 / std::numbers::pi;
}
/// rad, 0 to pi: how far one rotation is from another. Exactly 0 where they are equal.
inline double angle_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  if (from == to) return 0;
  return Eigen::Quaterniond(from).normalized().angularDistance(Eigen::Quaterniond(to).normalized());
}

}  // namespace glovebench
