#include <algorithm>

#include "trajectories/capture/calibrate_hand.h"

namespace glovebench::trajectories {
namespace {

// Fixed before any error was looked at.
const Eigen::Vector3d kPalmDeviation(0.004, 0.003, 0.005);  ///< of a joint in the palm, m
/// Of a segment, relative; more if its end is a point of the capture, which then says how long it is (rigs differ,
/// and most in where a tip is).
constexpr double kSegmentDeviation = 0.06, kSeenSegmentDeviation = 0.5;

bool has_joint_center(const CaptureHand& hand, int joint) {
  return std::ranges::any_of(hand.markers,
                             [&](const PlacedMarker& m) { return m.joint == joint && m.is_joint_center(); });
}

bool is_segment_end(int joint) { return joint_parents()[static_cast<size_t>(joint)] >= 0; }

constexpr int kMiddleMcp = 11, kIndexMcp = 6, kLittleMcp = 21;

}  // namespace

HandParameters::HandParameters(const CaptureHand& nominal) : nominal_(nominal) {
  std::vector<double> deviations;
  const auto add = [&](const Eigen::Vector3d& d) {
    const auto first = static_cast<int>(deviations.size());
    deviations.insert(deviations.end(), d.begin(), d.end());
    return first;
  };
  for (int j = 0; j < kForearmJoint; ++j) {
    first_of_joint_[static_cast<size_t>(j)] = static_cast<int>(deviations.size());
    if (is_segment_end(j))
      deviations.push_back(has_joint_center(nominal, j) ? kSeenSegmentDeviation : kSegmentDeviation);
    else
      add(kPalmDeviation);
  }
  first_of_joint_[kForearmJoint] = first_of_joint_[kWristJoint];  // begins at the wrist
  for (const PlacedMarker& marker : nominal.markers)
    first_of_marker_.push_back(marker.is_joint_center() ? -1 : add(marker.deviation));
  deviations_ = Eigen::Map<Eigen::VectorXd>(deviations.data(), static_cast<Eigen::Index>(deviations.size()));

  // Origin midway between wrist and middle MCP, both on the z axis, index and little MCP equally high.
  frame_constraints_ = Eigen::MatrixXd::Zero(6, size());
  const auto column = [&](int joint, int axis) { return first_of_joint_[static_cast<size_t>(joint)] + axis; };
  for (int axis = 0; axis < 2; ++axis) {
    frame_constraints_(axis, column(kWristJoint, axis)) = 1;
    frame_constraints_(2 + axis, column(kMiddleMcp, axis)) = 1;
  }
  frame_constraints_(4, column(kWristJoint, 2)) = 1;
  frame_constraints_(4, column(kMiddleMcp, 2)) = 1;
  frame_constraints_(5, column(kIndexMcp, 1)) = 1;
  frame_constraints_(5, column(kLittleMcp, 1)) = -1;
}

CaptureHand HandParameters::hand(const Eigen::VectorXd& parameters) const {
  CaptureHand hand = nominal_;
  for (int j = 0; j < kJointCount; ++j) {
    const int first = first_of_joint_[static_cast<size_t>(j)];
    const Eigen::Vector3d& offset = nominal_.skeleton.offset(j);
    hand.skeleton.set_offset(j, is_segment_end(j) ? Eigen::Vector3d((1 + parameters[first]) * offset)
                                                  : Eigen::Vector3d(offset + parameters.segment<3>(first)));
  }
  for (size_t m = 0; m < hand.markers.size(); ++m)
    if (first_of_marker_[m] >= 0) hand.markers[m].offset += parameters.segment<3>(first_of_marker_[m]);
  return hand;
}

Eigen::MatrixXd HandParameters::jacobian(const CaptureHand& hand, const HandState& state) const {
  const JointPoses T_hand_joint = hand.skeleton.pose(state.posture);
  const Eigen::Matrix3d R = state.T_capture_hand.linear();
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * hand.markers.size()), size());
  for (size_t m = 0; m < hand.markers.size(); ++m) {
    const PlacedMarker& marker = hand.markers[m];
    auto rows = jacobian.middleRows<3>(static_cast<Eigen::Index>(3 * m));
    if (first_of_marker_[m] >= 0)
      rows.middleCols<3>(first_of_marker_[m]) = R * marker_frame(marker, T_hand_joint).linear();
    for (int j = marker.joint; j >= 0; j = joint_parents()[static_cast<size_t>(j)]) {
      const int first = first_of_joint_[static_cast<size_t>(j)];
      if (is_segment_end(j)) {
        const int parent = joint_parents()[static_cast<size_t>(j)];
        rows.col(first) = R * T_hand_joint[static_cast<size_t>(parent)].linear() * nominal_.skeleton.offset(j);
      } else {
        rows.middleCols<3>(first) += R;
      }
    }
  }
  return jacobian;
}

CaptureHand scaled(const CaptureHand& hand, double factor) {
  CaptureHand result = hand;
  for (int j = 0; j < kJointCount; ++j) result.skeleton.set_offset(j, factor * hand.skeleton.offset(j));
  for (PlacedMarker& marker : result.markers) marker.offset *= factor;
  return result;
}

}  // namespace glovebench::trajectories
