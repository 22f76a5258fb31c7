#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <optional>
#include <vector>

namespace glovebench {

constexpr double radians_from_degrees(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double degrees_from_radians(double radians) { return radians * 180.0 / std::numbers::pi; }
/// 0 to pi rad. Exactly 0 for equal rotations.
inline double angle_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  if (from == to) return 0;
  return Eigen::Quaterniond(from).normalized().angularDistance(Eigen::Quaterniond(to).normalized());
}

/// The value above `share` (0.5: median) of all. Empty without values.
inline std::optional<double> quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return {};
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + std::min(place, static_cast<std::ptrdiff_t>(values.size()) - 1);
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace glovebench
