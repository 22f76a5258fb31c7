#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/hand/skeleton.h"
#include "trajectories/capture/marker_places.h"

namespace glovebench::trajectories {

/// The hand of a capture (a right one): where its joints and its markers lie.
struct CaptureHand {
  Skeleton skeleton;
  std::vector<PlacedMarker> markers;
};

/// What the hand does at one moment.
struct HandState {
  Posture posture = Posture::Zero();                                 ///< rad
  Eigen::Isometry3d T_capture_hand = Eigen::Isometry3d::Identity();  ///< m
};

/// A step of a state: a rotation vector about the hand's origin and a translation, both along the capture's axes,
/// and the angles.
inline constexpr int kStateSize = 6 + kAngleCount;
using StateStep = Eigen::Matrix<double, kStateSize, 1>;
/// The state after the step, within the joint limits.
HandState moved(const HandState& state, const StateStep& step);

/// Where the markers are, in the capture's frame.
std::vector<Eigen::Vector3d> predict_points(const CaptureHand& hand, const HandState& state);
/// Their derivative by a step: three rows for each marker.
Eigen::MatrixXd state_jacobian(const CaptureHand& hand, const HandState& state);

/// The pose of what a marker is fixed to, in the hand frame.
Eigen::Isometry3d marker_frame(const PlacedMarker& marker, const JointPoses& T_hand_joint);

}  // namespace glovebench::trajectories
