#include "core/pose/surface_pull.h"

namespace glovebench {
namespace {

constexpr double kInside = 1e-3;       ///< barycentric coordinates above it: not on an edge
constexpr double kNoDirection = 1e-5;  ///< m: nearer points have no direction

Eigen::Vector3d barycentric_in(const Surface::Face& face, const Eigen::Vector3f& p) {
  const Eigen::Vector3d ab = (face.b - face.a).cast<double>(), ac = (face.c - face.a).cast<double>();
  const Eigen::Vector3d ap = (p - face.a).cast<double>(), normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  if (!(area > 0)) return Eigen::Vector3d::Unit(0);
  const double b = ap.cross(ac).dot(normal) / area, c = ab.cross(ap).dot(normal) / area;
  return {1 - b - c, b, c};
}

}  // namespace

double tukey_weight(double distance, double width) {
  const double share = distance / width, rest = 1 - share * share;
  return rest > 0 ? rest * rest : 0;
}

SurfacePull surface_pull(const Surface::Face& face, const ClosestPoint& closest, const Eigen::Vector3f& p_hand,
                         double weight) {
  const Eigen::Vector3d q = closest.p_hand.cast<double>();
  const Eigen::Vector3d apart = p_hand.cast<double>() - q;
  const Eigen::Vector3d at = barycentric_in(face, closest.p_hand);
  const bool along_the_line = at.minCoeff() < kInside && apart.norm() > kNoDirection;
  const Eigen::Vector3d direction =
      along_the_line ? Eigen::Vector3d(apart.normalized())
                     : Eigen::Vector3d((face.b - face.a).cross(face.c - face.a).normalized().cast<double>());
  return {{q, direction, 1000 * direction.dot(apart), weight}, 1000 * apart, at};
}

}  // namespace glovebench
