#include "core/calibration/size_equations.h"

#include <Eigen/Cholesky>

#include "core/base/math.h"
#include "core/pose/articulated_step.h"
#include "core/pose/surface_matcher.h"

namespace glovebench::calibration {
namespace {

constexpr int kPointsOfView = 1500;  ///< of all, evenly chosen
constexpr double kPointsOfWeights = 1000;
constexpr double kAngleStep_deg = 0.5, kSizeStep_percent = 1;
/// Holds an angle where it is, per square degree: as much as the fine stage of the fit does.
constexpr double kAngleWeight = 0.005;
constexpr double kFixed = 1e6;  ///< holds an angle that is at a limit

constexpr int kAll = kUnknowns + kSizeCount;

bool is_at_limit(const Posture& posture, int angle) {
  const double deg = degrees_from_radians(posture[angle]);
  constexpr double kNear_deg = 1e-6;
  return deg < angle_infos()[angle].min_deg + kNear_deg || deg > angle_infos()[angle].max_deg - kNear_deg;
}

}  // namespace

SurfaceMotion::SurfaceMotion(const HandModel& model) : model_(model) {
  for (int size = 0; size < kSizeCount; ++size) {
    HandSizes factors = HandShape{}.sizes;
    factors[size] += kSizeStep_percent / 100;
    stretched_.push_back(model.stretched(factors));
  }
}

std::vector<Eigen::Vector3f> SurfaceMotion::at(const Posture& posture, const PosedHand& hand) const {
  std::vector<Eigen::Vector3f> moves(hand.vertices.size() * kMoves);
  const auto add = [&](int move, const PosedHand& moved, double step) {
    const auto per_step = static_cast<float>(1000 / step);
    for (size_t v = 0; v < hand.vertices.size(); ++v)
      moves[v * kMoves + move] = per_step * (moved.vertices[v] - hand.vertices[v]);
  };
  for (int a = 0; a < kAngleCount; ++a) {
    Posture bent = posture;
    bent[a] += radians_from_degrees(kAngleStep_deg);
    add(a, model_.pose(bent), kAngleStep_deg);
  }
  for (int size = 0; size < kSizeCount; ++size)
    add(kAngleCount + size, stretched_[size].pose(posture), kSizeStep_percent);
  return moves;
}

SizeEquations size_equations(const SurfaceMotion& motion, const TrackedView& view, const ArticulatedPose& pose,
                             double tukey_mm) {
  const HandModel& model = motion.model();
  const PosedHand hand = model.pose(pose.posture);
  SurfaceMatcher matcher(model, hand, subsample(view.seen.points, kPointsOfView), {});
  matcher.cull(pose.T_camera_hand);
  matcher.match(pose.T_camera_hand);
  const std::vector<Eigen::Vector3f> moves = motion.at(pose.posture, hand);

  const auto points = static_cast<int>(matcher.closest().size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kAll, points);  // of the Jacobian, side by side
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(points), distances = Eigen::VectorXd::Zero(points);
  for (int i = 0; i < points; ++i) {
    const ClosestPoint& closest = matcher.closest()[i];
    if (closest.face < 0) continue;
    weights[i] = tukey_weight(1000 * static_cast<double>(closest.distance), tukey_mm) * kPointsOfWeights / points;
    if (weights[i] == 0) continue;
    const Surface::Face& face = matcher.surface().faces(matcher.cloud()[i].label)[closest.face];
    const SurfacePull found = surface_pull(face, closest, matcher.points_hand()[i].p, 1);
    distances[i] = found.pull.distance_mm;
    rows.col(i).head<6>() = row_of(found.pull);
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f share = (found.barycentric[corner] * found.pull.direction).cast<float>();
      const Eigen::Vector3f* of_vertex =
          &moves[model.triangles()[face.triangle].vertices[corner] * size_t{SurfaceMotion::kMoves}];
      for (int m = 0; m < SurfaceMotion::kMoves; ++m)
        rows(6 + m, i) += static_cast<double>(share.dot(of_vertex[m]));
    }
  }
  const Eigen::MatrixXd weighted = rows * weights.asDiagonal();
  const Eigen::MatrixXd H = weighted * rows.transpose();
  const Eigen::VectorXd g = weighted * distances;

  StepMatrix of_pose = H.topLeftCorner<kUnknowns, kUnknowns>();
  for (int a = 0; a < kAngleCount; ++a)
    of_pose(6 + a, 6 + a) += is_at_limit(pose.posture, a) ? kFixed : kAngleWeight;
  const Eigen::LDLT<StepMatrix> solver(of_pose);
  SizeEquations result;
  result.pose_step = solver.solve(g.head<kUnknowns>());
  result.pose_by_sizes = solver.solve(H.topRightCorner<kUnknowns, kSizeCount>());
  const auto between = H.bottomLeftCorner<kSizeCount, kUnknowns>();
  result.H = H.bottomRightCorner<kSizeCount, kSizeCount>() - between * result.pose_by_sizes;
  result.g = g.tail<kSizeCount>() - between * result.pose_step;
  return result;
}

}  // namespace glovebench::calibration
