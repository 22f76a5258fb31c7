#include "core/pose/articulated_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/math.h"

namespace glovebench {
namespace {

constexpr double kMmPerDegree = radians_from_degrees(1000.0);  ///< at 1 m from the axis

/// The screw as it acts on a row: n . (q x d) + m . d, for a degree and in millimeters.
Vector6d on_rows(const Screw& screw) {
  Vector6d result;
  result << screw.axis, kMmPerDegree * screw.moment;
  return result;
}

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
  const bool along_the_line = at.minCoeff() < kInside && apart.norm() > kNoDirection;
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

PullSums::PullSums(const std::array<Screw, kAngleCount>& screws) {
  for (int a = 0; a < kAngleCount; ++a) screws_[a] = on_rows(screws[a]);
  sums_.fill(Vector6d::Zero());
}

void RowSums::add(const Pull& pull) {
  const Vector6d row = row_of(pull), weighted = pull.weight * row;
  int next = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) products[next++] += weighted[i] * row[j];
  sum += pull.distance_mm * weighted;
}

void RowSums::add_along_axes(const Eigen::Vector3d& q, const Eigen::Vector3d& apart_mm, double weight) {
  // The rows (a x e, e) of the axes e make (|a|^2 I - a a^T) of the turn, the cross product's matrix between the
  // two, and I of the shift.
  const Eigen::Vector3d a = kMmPerDegree * q, w = weight * a;
  const double square = w.dot(a);
  Eigen::Matrix<double, 21, 1> of_axes;
  of_axes << square - w.x() * a.x(), -w.x() * a.y(), -w.x() * a.z(), 0, -w.z(), w.y(),  //
      square - w.y() * a.y(), -w.y() * a.z(), w.z(), 0, -w.x(),                         //
      square - w.z() * a.z(), -w.y(), w.x(), 0,                                         //
      weight, 0, 0, weight, 0, weight;
  products += of_axes;
  sum.head<3>() += w.cross(apart_mm);
  sum.tail<3>() += weight * apart_mm;
}

void PullSums::add(const RowSums& pulls_at_point, const BodyList& bodies) {
  for (int i = 0; i < bodies.count; ++i) {
    sums_[bodies.body[i]] += bodies.share[i] * pulls_at_point.sum;
    for (int j = 0; j <= i; ++j) {
      const int low = std::min(bodies.body[i], bodies.body[j]), high = std::max(bodies.body[i], bodies.body[j]);
      Pair& pair = pairs_[high * (high + 1) / 2 + low];
      if (!std::exchange(pair.is_used, true)) pair.products.setZero();
      pair.products += (bodies.share[i] * bodies.share[j]) * pulls_at_point.products;
    }
  }
}

NormalEquations PullSums::equations() const {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  NormalEquations result;
  std::array<Matrix6d, kBodyCount> of_bodies;  // the body's products with all bodies
  of_bodies.fill(Matrix6d::Zero());
  for (int high = 0; high < kBodyCount; ++high) {
    for (int low = 0; low <= high; ++low) {
      const Pair& pair = pairs_[high * (high + 1) / 2 + low];
      if (!pair.is_used) continue;
      Matrix6d S;
      int next = 0;
      for (int i = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j) S(i, j) = S(j, i) = pair.products[next++];
      of_bodies[high] += S;
      if (low != high) of_bodies[low] += S;
      for (uint32_t b = angles_of_body(high); b != 0; b &= b - 1) {
        const int right = std::countr_zero(b);
        const Vector6d moved_by = S * screws_[right];
        for (uint32_t a = angles_of_body(low); a != 0; a &= a - 1) {
          const int left = std::countr_zero(a);
          const double product = screws_[left].dot(moved_by);
          result.H(6 + left, 6 + right) += product;
          if (low != high) result.H(6 + right, 6 + left) += product;
        }
      }
    }
  }
  for (int body = 0; body < kBodyCount; ++body) {
    result.H.topLeftCorner<6, 6>() += of_bodies[body];
    result.g.head<6>() += sums_[body];
    for (uint32_t a = angles_of_body(body); a != 0; a &= a - 1) {
      const int angle = std::countr_zero(a);
      result.H.col(6 + angle).head<6>() += of_bodies[body] * screws_[angle];
      result.g[6 + angle] += screws_[angle].dot(sums_[body]);
    }
  }
  result.H.bottomLeftCorner<kAngleCount, 6>() = result.H.topRightCorner<6, kAngleCount>().transpose();
  return result;
}

void NormalEquations::hold(int angle, double away_deg, double weight) {
  H(6 + angle, 6 + angle) += weight;
  g[6 + angle] += weight * away_deg;
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
