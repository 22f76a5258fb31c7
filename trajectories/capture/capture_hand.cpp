#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The joint that each angle turns, and whether a joint hangs on it.
struct Turned {
  std::array<int, kAngleCount> joint;
  std::array<std::array<bool, kJointCount>, kAngleCount> carries = {};
};
const Turned& turned() {
  static const Turned table = [] {
    Turned result;
    for (size_t a = 0; a < kAngleCount; ++a) {
      result.joint[a] = joint_of_angle(static_cast<int>(a));
      for (int joint = 0; joint < kJointCount; ++joint) {
        for (int j = joint; j >= 0; j = joint_parents()[static_cast<size_t>(j)]) {
          if (j == result.joint[a]) result.carries[a][static_cast<size_t>(joint)] = true;
        }
      }
    }
    return result;
  }();
  return table;
}

}  // namespace

HandState moved(const HandState& state, const StateStep& step) {
  HandState result = state;
  const Eigen::Vector3d turn = step.head<3>();
  if (turn.norm() > 0) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * state.T_capture_hand.linear();
    result.T_capture_hand.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  }
  result.T_capture_hand.translation() += step.segment<3>(3);
  result.posture = clamp_to_limits(state.posture + step.tail<kAngleCount>());
  return result;
}

Eigen::Isometry3d marker_frame(const PlacedMarker& marker, const JointPoses& T_hand_joint) {
  return marker.joint == kPalm ? Eigen::Isometry3d::Identity() : T_hand_joint[static_cast<size_t>(marker.joint)];
}

std::vector<Eigen::Vector3d> predict_points(const CaptureHand& hand, const HandState& state) {
  const JointPoses T_hand_joint = hand.skeleton.pose(state.posture);
  std::vector<Eigen::Vector3d> points;
  for (const PlacedMarker& marker : hand.markers) {
    points.push_back(state.T_capture_hand * (marker_frame(marker, T_hand_joint) * marker.offset));
  }
  return points;
}

Eigen::MatrixXd state_jacobian(const CaptureHand& hand, const HandState& state) {
  const JointPoses T_hand_joint = hand.skeleton.pose(state.posture);
  const std::array<Eigen::Vector3d, kAngleCount> axes = hand.skeleton.axes(T_hand_joint);
  const Eigen::Matrix3d R = state.T_capture_hand.linear();
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<int>(3 * hand.markers.size()), kStateSize);
  for (size_t m = 0; m < hand.markers.size(); ++m) {
    const PlacedMarker& marker = hand.markers[m];
    const Eigen::Vector3d p_hand = marker_frame(marker, T_hand_joint) * marker.offset;
    auto rows = jacobian.middleRows<3>(static_cast<int>(3 * m));
    rows.leftCols<3>() = -cross_matrix(R * p_hand);
    rows.middleCols<3>(3).setIdentity();
    if (marker.joint == kPalm) continue;
    for (size_t a = 0; a < kAngleCount; ++a) {
      if (!turned().carries[a][static_cast<size_t>(marker.joint)]) continue;
      const Eigen::Vector3d center = T_hand_joint[static_cast<size_t>(turned().joint[a])].translation();
      rows.col(6 + static_cast<int>(a)) = R * axes[a].cross(p_hand - center);
    }
  }
  return jacobian;
}

}  // namespace glovebench::trajectories
