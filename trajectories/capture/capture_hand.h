#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/hand/skeleton.h"
#include "trajectories/capture/marker_places.h"

namespace glovebench::trajectories {

/// A right hand.
struct CaptureHand {
  Skeleton skeleton;
  std::vector<PlacedMarker> markers;
};

struct HandState {
  Posture posture = Posture::Zero();                                 ///< rad
  Eigen::Isometry3d T_capture_hand = Eigen::Isometry3d::Identity();  ///< m
};

/// Rotation about the hand origin, translation (both capture frame), angles.
inline constexpr int kStateSize = 6 + kAngleCount;
using StateStep = Eigen::Matrix<double, kStateSize, 1>;
/// Within joint limits.
HandState moved(const HandState& state, const StateStep& step);

/// Marker positions, capture frame, m.
std::vector<Eigen::Vector3d> predict_points(const CaptureHand& hand, const HandState& state);
/// Of predict_points, three rows per marker.
Eigen::MatrixXd state_jacobian(const CaptureHand& hand, const HandState& state);

/// T_hand_joint of the marker's joint or palm.
Eigen::Isometry3d marker_frame(const PlacedMarker& marker, const JointPoses& T_hand_joint);

/// Size relative to `hand`: median ratio of distances that no posture changes; 1 without any. `points`:
/// [frame][marker], or gaps.
/// Throws: Error for an impossible size.
double hand_scale(const CaptureHand& hand, const std::vector<std::vector<Eigen::Vector3d>>& points,
                  const std::string& where);

/// Guesses frames from neighbors, beginning with the one of most points.
/// Throws: Error if no frame has three palm points.
std::vector<HandState> start_states(const CaptureHand& hand,
                                    const std::vector<std::vector<Eigen::Vector3d>>& points, double robust_scale,
                                    const std::string& where);

}  // namespace glovebench::trajectories
