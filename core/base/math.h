#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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

/// The nearest points of two segments. Both need a length.
inline std::array<Eigen::Vector3d, 2> nearest_points(const std::array<Eigen::Vector3d, 2>& a,
                                                     const std::array<Eigen::Vector3d, 2>& b) {
  const Eigen::Vector3d along_a = a[1] - a[0], along_b = b[1] - b[0], between = a[0] - b[0];
  const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  const double a_between = along_a.dot(between), b_between = along_b.dot(between);
  const double determinant = aa * bb - ab * ab;
  constexpr double kParallel = 1e-9;  // of aa * bb
  double s = determinant > kParallel * aa * bb ? (ab * b_between - a_between * bb) / determinant : 0;
  s = std::clamp(s, 0.0, 1.0);
  const double t = std::clamp((ab * s + b_between) / bb, 0.0, 1.0);
  s = std::clamp((ab * t - a_between) / aa, 0.0, 1.0);
  return {a[0] + s * along_a, b[0] + t * along_b};
}

}  // namespace glovebench
