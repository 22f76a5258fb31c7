#include "core/pose/alignments/robust_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/pose/horn.h"

namespace glovebench {
namespace {

/// `tangential`: in a step on planes, the weight of a distance along the surface.
struct Step {
  enum class Kind { horn, planes } kind;
  double tangential = 0;
};
constexpr Step kHorn{Step::Kind::horn}, kMixed{Step::Kind::planes, 0.3}, kPlanes{Step::Kind::planes, 0};
constexpr Step kOnSome[] = {kHorn, kHorn, kHorn, kMixed, kMixed, kMixed, kPlanes, kPlanes, kPlanes};
constexpr Step kOnAll[] = {kPlanes, kPlanes};

/// The first steps use every fifth point, but keep at least a hundred.
constexpr size_t kStride = 5;
constexpr size_t kEnough = 100;

/// Relative change of the mean distance below which it has settled. It is larger than for Horn's smaller steps.
constexpr double kSettled = 0.01;

struct Pair {
  Eigen::Vector3d p, q;  ///< of the cloud and its closest on the hand; hand frame
  Eigen::Vector3d normal;
};

RecycledVector<Pair> pairs_of(const SurfaceMatcher& matcher) {
  RecycledVector<Pair> pairs;
  for (size_t i = 0; i < matcher.closest().size(); ++i) {
    const ClosestPoint& closest = matcher.closest()[i];
    if (closest.face < 0) continue;
    const Surface::Face& face = matcher.surface().faces(matcher.cloud()[i].label)[closest.face];
    const Eigen::Vector3f normal = (face.b - face.a).cross(face.c - face.a).normalized();
    pairs.push_back(
        {matcher.points_hand()[i].p.cast<double>(), closest.p_hand.cast<double>(), normal.cast<double>()});
  }
  return pairs;
}

double mean_distance(const RecycledVector<Pair>& pairs) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += (pair.q - pair.p).norm();
  return sum / static_cast<double>(pairs.size());
}

/// The textbook's width of Tukey's biweight, in standard deviations: it keeps 95% of the efficiency of least
/// squares under Gaussian noise. A standard deviation is 1.4826 times the median absolute residual. A narrower
/// width is better for a slightly wrong posture, where a third of the points do not fit (bench/README.md,
/// icp/errors).
constexpr double kTextbookWidth = 4.685;

class Tukey {
 public:
  /// `width`: as a share of the textbook's.
  Tukey(RecycledVector<double> residuals, double width) {
    const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
    std::nth_element(residuals.begin(), middle, residuals.end());
    // Never narrower than a tenth of a millimeter: without noise the median is rounding.
    width_ = width * kTextbookWidth * std::max(1.4826 * *middle, 1e-4);
  }
  double weight(double residual) const {
    const double share = residual / width_;
    const double rest = 1 - share * share;
    return rest > 0 ? rest * rest : 0;
  }

 private:
  double width_;
};

/// The motion of a rotation vector and a translation.
Eigen::Isometry3d motion(const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = turn.norm();
  if (angle > 0) T.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  T.translation() = shift;
  return T;
}

/// The motion of the points towards the hand by one Gauss-Newton step. Empty if a motion is undetermined.
std::optional<Eigen::Isometry3d> step_on_planes(const RecycledVector<Pair>& pairs, double tangential,
                                                double width) {
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  RecycledVector<double> distances;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Pair& pair : pairs) {
    distances.push_back((pair.q - pair.p).norm());
    center += pair.p;
  }
  center /= static_cast<double>(pairs.size());
  const Tukey tukey(distances, width);
  Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6d g = Vector6d::Zero();
  const auto add = [&](const Eigen::Vector3d& arm, const Eigen::Vector3d& direction, double residual,
                       double weight) {
    Vector6d row;
    row << arm.cross(direction), direction;
    H.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    g += weight * residual * row;
  };
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Pair& pair = pairs[i];
    const double weight = tukey.weight(distances[i]);
    if (weight == 0) continue;
    // Arms in units of 10 cm give rotation and translation equal scale.
    const Eigen::Vector3d arm = 10 * (pair.p - center), apart = pair.q - pair.p;
    add(arm, pair.normal, pair.normal.dot(apart), weight * (1 - tangential));
    if (tangential == 0) continue;
    for (int axis = 0; axis < 3; ++axis) add(arm, Eigen::Vector3d::Unit(axis), apart[axis], weight * tangential);
  }
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(H.selfadjointView<Eigen::Lower>());
  const Vector6d pivots = solver.vectorD();
  // A spread below a thousandth counts as a line, as in Horn's alignment.
  if (!(pivots.minCoeff() > 1e-6 * pivots.maxCoeff())) return {};
  const Vector6d solution = solver.solve(g);
  if (!solution.allFinite()) return {};
  const Eigen::Isometry3d about_center = motion(10 * solution.head<3>(), solution.tail<3>());
  return Eigen::Translation3d(center) * about_center * Eigen::Translation3d(-center);
}

std::optional<Eigen::Isometry3d> step_of_horn(const RecycledVector<Pair>& pairs) {
  RecycledVector<Eigen::Vector3f> from, to;
  for (const Pair& pair : pairs) {
    from.push_back(pair.p.cast<float>());
    to.push_back(pair.q.cast<float>());
  }
  return align_points(from, to);
}

/// Takes all steps, or returns false with the reason in `result.status`.
bool take_steps(SurfaceMatcher& matcher, std::span<const Step> steps, const IcpConfig& config, double width,
                Alignment& result) {
  matcher.cull(result.T_camera_hand);
  for (const Step& step : steps) {
    if (result.iterations == config.max_iterations) return true;
    if (config.cull_each_iteration) matcher.cull(result.T_camera_hand);
    matcher.match(result.T_camera_hand);
    const RecycledVector<Pair> pairs = pairs_of(matcher);
    if (pairs.size() < 3) {
      result.status = AlignmentStatus::no_shared_color;
      return false;
    }
    result.residual = mean_distance(pairs);
    // Horn's step also works for planes that leave a motion undetermined, such as a single flat patch.
    std::optional<Eigen::Isometry3d> moved;
    if (step.kind == Step::Kind::planes) moved = step_on_planes(pairs, step.tangential, width);
    if (!moved) moved = step_of_horn(pairs);
    if (!moved) {
      result.status = AlignmentStatus::degenerate_cloud;
      return false;
    }
    result.T_camera_hand = result.T_camera_hand * moved->inverse();
    ++result.iterations;
  }
  return true;
}

}  // namespace

Alignment align_robust(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                       const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config, double width) {
  Alignment result;
  result.T_camera_hand = T_camera_hand_coarse;
  result.points = static_cast<int>(points.size());
  const size_t stride = std::clamp<size_t>(points.size() / kEnough, 1, kStride);
  SurfaceMatcher some(model, hand, every_nth(points, stride), config);
  SurfaceMatcher all(model, hand, std::move(points), config);
  if (!take_steps(some, kOnSome, config, width, result)) {
    // All points may share a color with the hand although a part of them does not.
    result.T_camera_hand = T_camera_hand_coarse;
    result.iterations = 0;
    if (!take_steps(all, kOnSome, config, width, result)) return result;
  }
  if (!take_steps(all, kOnAll, config, width, result)) return result;
  all.match(result.T_camera_hand);
  const RecycledVector<Pair> pairs = pairs_of(all);
  if (pairs.size() < 3) {
    result.status = AlignmentStatus::no_shared_color;
    return result;
  }
  const double before = result.residual;
  result.residual = mean_distance(pairs);
  const bool settled = std::abs(before - result.residual) <= std::max(kSettled, config.convergence_share) * before;
  const bool whole = result.iterations == static_cast<int>(std::size(kOnSome) + std::size(kOnAll));
  result.status = whole && settled ? AlignmentStatus::converged : AlignmentStatus::not_converged;
  return result;
}

AlignmentEntry robust_alignment() {
  return {"robust", "steps of Horn, then point-to-plane steps with Tukey's weights",
          [](const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
             const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config) {
            return align_robust(model, hand, std::move(points), T_camera_hand_coarse, config);
          }};
}

}  // namespace glovebench
