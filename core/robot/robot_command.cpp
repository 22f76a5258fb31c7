#include "core/robot/robot_command.h"

#include "core/base/error.h"

namespace glovebench {

Eigen::Isometry3d default_T_base_camera() {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() << 0, -1, 0,  // image rows run towards the arm
      -1, 0, 0,                        // image columns run to its right
      0, 0, -1;
  T_base_camera.translation() << 0.9, 0, 1.2;
  return T_base_camera;
}

RobotCommander::RobotCommander(const Eigen::Isometry3d& T_base_camera) : T_base_camera_(T_base_camera) {
  const Eigen::Matrix3d R = T_base_camera.linear();
  // 1e-6 admits a matrix that was written with seven digits.
  const bool rotation = R.allFinite() && R.isUnitary(1e-6) && R.determinant() > 0;
  if (!rotation || !T_base_camera.translation().allFinite())
    throw Error("robot", "T_base_camera", "no rigid transform", "a finite translation and a rotation matrix");
}

RobotCommand RobotCommander::command(const TrackResult& result) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = result.timestamp_us;
  command.status = result.status;
  command.hold = result.status != TrackStatus::tracked;
  if (!command.hold) {
    if (!result.T_camera_hand.matrix().allFinite())
      throw Error("robot command", "T_camera_hand", "a value that is not finite", "a finite pose");
    last_ = RobotTargets{map_to_shadow_hand(result.posture), T_base_camera_ * result.T_camera_hand, std::nullopt};
  }
  command.targets = last_;
  command.state = !command.hold ? CommandState::following : last_ ? CommandState::holding : CommandState::stopped;
  return command;
}

}  // namespace glovebench
