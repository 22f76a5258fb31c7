#include "core/pose/horn.h"

#include <Eigen/Eigenvalues>

#include "core/base/error.h"

namespace glovebench {
namespace {

Eigen::Vector3d mean(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

/// The points spread in one direction only, within a thousandth of it.
bool on_a_line(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& center) {
  // The six sums as locals: each waits for its last addition only, not for a matrix in memory.
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const Eigen::Vector3f& p : points) {
    const double x = p.x() - center.x(), y = p.y() - center.y(), z = p.z() - center.z();
    xx += x * x, xy += x * y, xz += x * z, yy += y * y, yz += y * z, zz += z * z;
  }
  Eigen::Matrix3d covariance;
  covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Eigen::Vector3d spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
  return spread[1] <= 1e-6 * spread[2];
}

}  // namespace

std::optional<Eigen::Isometry3d> align_points(std::span<const Eigen::Vector3f> from,
                                              std::span<const Eigen::Vector3f> to) {
  check(from.size() == to.size(), "points are paired");
  if (from.size() < 3) return {};
  const Eigen::Vector3d center_from = mean(from), center_to = mean(to);
  if (on_a_line(from, center_from) || on_a_line(to, center_to)) return {};

  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  const Eigen::Vector3f *a = from.data(), *b = to.data();  // hardened builds check every index of a span
  for (size_t i = 0; i < from.size(); ++i)
    S += (a[i].cast<double>() - center_from) * (b[i].cast<double>() - center_to).transpose();
  Eigen::Matrix4d N;  // Horn 1987, section 4.A; quaternion order w, x, y, z
  N << S.trace(), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0),                   //
      S(1, 2) - S(2, 1), S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2),  //
      S(2, 0) - S(0, 2), S(0, 1) + S(1, 0), S(1, 1) - S(0, 0) - S(2, 2), S(1, 2) + S(2, 1),  //
      S(0, 1) - S(1, 0), S(2, 0) + S(0, 2), S(1, 2) + S(2, 1), S(2, 2) - S(0, 0) - S(1, 1);
  const Eigen::Vector4d q = largest_eigenvector(N);

  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  T.translation() = center_to - T.linear() * center_from;
  return T;
}

Eigen::Vector4d largest_eigenvector(const Eigen::Matrix4d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(matrix).eigenvectors().col(3);
}

}  // namespace glovebench
