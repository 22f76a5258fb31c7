#pragma once

#include "ci/build_paths.h"
#include "core/hand/hand_model.h"

namespace glovebench::render {

inline const HandModel& test_hand() {
  static const HandModel model = HandModel::load(build_paths::hand_mesh());
  return model;
}

/// Fingers cover each other.
inline Posture test_posture() {
  Posture posture = Posture::Zero();
  posture[kWristFlexion] = 0.3;
  posture[kThumbCmcFlexion] = 0.4;
  posture[kIndexMcpFlexion] = 0.9;
  posture[kIndexPipFlexion] = 1.1;
  posture[kMiddlePipFlexion] = 0.5;
  return posture;
}

/// Back of the hand to the camera, fingers up, then turned about x, y, z.
inline Eigen::Isometry3d test_pose(const Eigen::Vector3d& position,
                                   const Eigen::Vector3d& turn = {0.4, -0.5, 0.3}) {
  Eigen::Matrix3d R_camera_hand;
  R_camera_hand << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  T_camera_hand.translation() = position;
  T_camera_hand.linear() = Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX()) *
                           Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ()) * R_camera_hand;
  return T_camera_hand;
}

}  // namespace glovebench::render
