#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/hand/skeleton.h"
#include "trajectories/capture/marker_places.h"

namespace glovebench::trajectories {

/// A captured right hand.
struct CaptureHand {
  Skeleton skeleton;
  std::vector<PlacedMarker> markers;
};

struct HandState {
  Posture posture = Posture::Zero();                                 ///< rad
  Eigen::Isometry3d T_capture_hand = Eigen::Isometry3d::Identity();  ///< m
};

/// Rotation vector about the hand origin and translation, capture frame; then angles.
inline constexpr int kStateSize = 6 + kAngleCount;
using StateStep = Eigen::Matrix<double, kStateSize, 1>;
/// Takes a step within joint limits.
HandState moved(const HandState& state, const StateStep& step);

/// Marker positions in the capture frame.
std::vector<Eigen::Vector3d> predict_points(const CaptureHand& hand, const HandState& state);
/// Derivative of predict_points, three rows a marker.
Eigen::MatrixXd state_jacobian(const CaptureHand& hand, const HandState& state);

/// Pose, in the hand frame, of the frame that holds a marker.
Eigen::Isometry3d marker_frame(const PlacedMarker& marker, const JointPoses& T_hand_joint);

}  // namespace glovebench::trajectories
