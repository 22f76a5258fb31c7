#pragma once

#include "ci/build_paths.h"
#include "core/tracker/track_result.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {

inline Posture some_posture() {
  Posture posture = Posture::Zero();
  posture[kIndexMcpFlexion] = 0.4;
  posture[kRingPipFlexion] = 0.7;
  return posture;
}

inline Eigen::Isometry3d some_pose() {
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  T_camera_hand.linear() = Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  T_camera_hand.translation() = Eigen::Vector3d(0.05, -0.02, 0.7);
  return T_camera_hand;
}

inline const HandModel& example_hand() {
  static const HandModel hand = HandModel::load(build_paths::hand_mesh());
  return hand;
}

inline FrameTruth example_truth() {
  return {some_posture(), some_pose(), example_hand().pose(some_posture()).T_hand_joint, {}};
}

inline TrackResult make_estimate() {
  TrackResult estimate;
  estimate.timestamp_us = 66667;
  estimate.status = TrackStatus::tracked;
  estimate.posture = estimate.posture_unfiltered = some_posture();
  estimate.T_camera_hand = some_pose();
  return estimate;
}

}  // namespace glovebench::reports
