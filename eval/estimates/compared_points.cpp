#include "eval/estimates/compared_points.h"

#include "core/base/math.h"

namespace glovebench::eval {
namespace {

/// Origin, and points 10 cm along the axes, about a hand's size.
Points frame_points(const Eigen::Isometry3d& T_camera_hand) {
  Points points(3, 4);
  points.col(0) = T_camera_hand.translation();
  points.rightCols<3>() = (0.1 * T_camera_hand.linear()).colwise() + T_camera_hand.translation();
  return points;
}

/// The chosen joints; all of them if none is chosen.
Points joint_points(const Eigen::Isometry3d& T_camera_hand, const JointPoses& T_hand_joint,
                    std::span<const int> chosen) {
  Points points(3, chosen.empty() ? kForearmJoint : std::ssize(chosen));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = T_camera_hand * T_hand_joint[chosen.empty() ? i : chosen[i]].translation();
  return points;
}

}  // namespace

Points PointComparison::of(const TrackResult& answer) const {
  if (!joints.empty()) {
    Points points(3, joints.size());
    for (size_t j = 0; j < joints.size(); ++j) points.col(static_cast<Eigen::Index>(j)) = *answer.joints[joints[j]];
    return points;
  }
  if (has.hand()) return joint_points(answer.T_camera_hand, hand->pose(answer.posture).T_hand_joint, {});
  return has.pose ? frame_points(answer.T_camera_hand) : Points(answer.posture.transpose());
}

Points PointComparison::of(const HandFrame& truth, const render::Subject& subject) const {
  if (has_joints()) return joint_points(truth.T_camera_hand, subject.joints(truth.posture), joints);
  return has.pose ? frame_points(truth.T_camera_hand) : Points(truth.posture.transpose());
}

double PointComparison::distance(const Points& estimated, const Points& truth) const {
  if (!has_points()) return degrees_from_radians((estimated - truth).norm() / std::sqrt(double{kAngleCount}));
  if (has.place && has.scale) return 1000 * (estimated - truth).colwise().norm().mean();
  Points a = estimated.colwise() - estimated.rowwise().mean(), b = truth.colwise() - truth.rowwise().mean();
  if (!has.scale) a *= b.norm() / a.norm();
  return 1000 * (a - b).colwise().norm().mean();
}

std::vector<Points> points_of(const PointComparison& comparison, std::span<const HandFrame> truth,
                              const render::Subject& subject) {
  std::vector<Points> points;
  for (const HandFrame& frame : truth) points.push_back(comparison.of(frame, subject));
  return points;
}

}  // namespace glovebench::eval
