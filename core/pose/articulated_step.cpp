#include "core/pose/articulated_step.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/base/math.h"

namespace glovebench {
namespace {

Eigen::Vector3d barycentric_in(const Surface::Face& face, const Eigen::Vector3f& p) {
  const Eigen::Vector3d ab = (face.b - face.a).cast<double>(), ac = (face.c - face.a).cast<double>();
  const Eigen::Vector3d ap = (p - face.a).cast<double>(), normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  if (!(area > 0)) return Eigen::Vector3d::Unit(0);
  const double b = ap.cross(ac).dot(normal) / area, c = ab.cross(ap).dot(normal) / area;
  return {1 - b - c, b, c};
}

/// The shares of a place in a triangle.
BodyShares shares_at(const Triangle& triangle, const Eigen::Vector3d& barycentric,
                     std::span<const BodyShares> shares) {
  BodyShares result{};
  for (int body = 0; body < kBodyCount; ++body)
    for (int c = 0; c < 3; ++c)
      result[body] += static_cast<float>(barycentric[c]) * shares[triangle.vertices[c]][body];
  return result;
}

}  // namespace

Vector6d on_rows(const Screw& screw) {
  Vector6d result;
  result << screw.axis, kMmPerDegree * screw.moment;
  return result;
}

Vector6d row_of(const Pull& pull) {
  Vector6d row;
  row << kMmPerDegree * pull.q.cross(pull.direction), pull.direction;
  return row;
}

double tukey_weight(double distance, double width) {
  const double share = distance / width, rest = 1 - share * share;
  return rest > 0 ? rest * rest : 0;
}

SurfacePull surface_pull(const Surface::Face& face, const ClosestPoint& closest, const Eigen::Vector3f& p_hand,
                         double weight) {
  const Eigen::Vector3d q = closest.p_hand.cast<double>();
  const Eigen::Vector3d apart = p_hand.cast<double>() - q;
  const Eigen::Vector3d at = barycentric_in(face, closest.p_hand);
  const bool along_the_line = at.minCoeff() < kInsideFace && apart.norm() > kNoDirection;
  const Eigen::Vector3d direction =
      along_the_line ? Eigen::Vector3d(apart.normalized())
                     : Eigen::Vector3d((face.b - face.a).cross(face.c - face.a).normalized().cast<double>());
  return {{q, direction, 1000 * direction.dot(apart), weight}, 1000 * apart, at};
}

void PlainPullSums::add(const Pull& pull, const BodyShares& shares) {
  const AngleShares of_angles = angle_shares(shares);
  StepVector row;
  row.head<6>() = row_of(pull);
  for (int a = 0; a < kAngleCount; ++a)
    row[6 + a] = static_cast<double>(of_angles[a]) * on_rows(screws_[a]).dot(row.head<6>());
  equations_.H += pull.weight * row * row.transpose();
  equations_.g += pull.weight * pull.distance_mm * row;
}

void PlainPullSums::add(const MatchedPoints& matched, std::span<const Triangle> triangles,
                        std::span<const BodyShares> shares, const PullWeights& weights) {
  for (size_t i = 0; i < matched.closest.size(); ++i) {
    const ClosestPoint& closest = matched.closest[i];
    if (closest.face < 0) continue;
    const LabeledPoint& point = matched.points[i];
    const double weight = tukey_weight(1000 * static_cast<double>(closest.distance), weights.tukey_mm);
    const Surface::Face& face = matched.surface.faces(point.label)[closest.face];
    const auto [pull, apart_mm, barycentric] =
        surface_pull(face, closest, point.p, weight * (1 - weights.tangential));
    const BodyShares at = shares_at(triangles[face.triangle], barycentric, shares);
    add(pull, at);
    for (int axis = 0; axis < 3; ++axis)
      add({pull.q, Eigen::Vector3d::Unit(axis), apart_mm[axis], weight * weights.tangential}, at);
  }
}

void NormalEquations::hold(int angle, double away_deg, double weight) {
  H(6 + angle, 6 + angle) += weight;
  g[6 + angle] += weight * away_deg;
}

double may_overlap(const BonePair& pair) {
  return pair.fingers[0] == 0 || pair.fingers[1] == 0 ? kThumbMayOverlap : kBonesMayOverlap;
}

void push_apart(NormalEquations& equations, const std::array<Screw, kAngleCount>& screws, const BonePair& pair,
                double weight) {
  const Eigen::Vector3d between = pair.nearest[0] - pair.nearest[1];
  const double distance = between.norm();
  const double excess_mm = 1000 * (pair.overlap - may_overlap(pair));
  if (!(excess_mm > 0 && distance > kNoDirection)) return;
  const Eigen::Vector3d direction = between / distance;
  StepVector row = StepVector::Zero();
  for (const int side : {0, 1}) {
    const Vector6d motion = row_of({pair.nearest[side], side == 0 ? direction : Eigen::Vector3d(-direction)});
    for (int a = 0; a < kAngleCount; ++a)
      if (pair.angles[side] >> a & 1) row[6 + a] += on_rows(screws[a]).dot(motion);
  }
  equations.H += weight * row * row.transpose();
  equations.g += weight * excess_mm * row;
}

std::optional<StepVector> solve_within_limits(const NormalEquations& equations, const Posture& posture,
                                              bool only_pose) {
  StepMatrix H = equations.H;
  StepVector g = equations.g;
  std::array<bool, kAngleCount> is_fixed{};
  // The step of an angle becomes known: its column goes to the right-hand side.
  const auto fix = [&](int angle, double step_deg) {
    const int i = 6 + angle;
    g -= step_deg * H.col(i);
    H.row(i).setZero();
    H.col(i).setZero();
    H(i, i) = 1;
    g[i] = step_deg;
    is_fixed[angle] = true;
  };
  if (only_pose)
    for (int a = 0; a < kAngleCount; ++a) fix(a, 0);
  while (true) {
    const Eigen::LDLT<StepMatrix> solver(H);
    const StepVector pivots = solver.vectorD();
    if (!(pivots.minCoeff() > 1e-9 * pivots.maxCoeff())) return {};
    const StepVector step = solver.solve(g);
    if (!step.allFinite()) return {};
    bool is_within = true;
    for (int a = 0; a < kAngleCount; ++a) {
      if (is_fixed[a]) continue;
      const double from_deg = degrees_from_radians(posture[a]);
      const double to_deg = from_deg + step[6 + a];
      const double limited = std::clamp(to_deg, angle_infos()[a].min_deg, angle_infos()[a].max_deg);
      if (limited == to_deg) continue;
      fix(a, limited - from_deg);
      is_within = false;
    }
    if (is_within) return step;
  }
}

ArticulatedPose moved(const ArticulatedPose& pose, const StepVector& step) {
  ArticulatedPose result;
  for (int a = 0; a < kAngleCount; ++a) result.posture[a] = pose.posture[a] + radians_from_degrees(step[6 + a]);
  result.posture = clamp_to_limits(result.posture);  // rounding
  const Eigen::Vector3d turn = step.head<3>() * radians_from_degrees(1.0);
  const double angle = turn.norm();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (angle > 0) motion.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  motion.translation() = step.segment<3>(3) / 1000;
  result.T_camera_hand = pose.T_camera_hand * motion;
  // Products of many steps stay rotations.
  result.T_camera_hand.linear() = Eigen::Quaterniond(result.T_camera_hand.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace glovebench
