#pragma once

#include "core/robot/robot_command.h"

namespace glovebench {

/// All joints at zero, the hand at (0.5, 0, 0.5) m.
inline RobotCommand good_command(int64_t timestamp_us) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = timestamp_us;
  command.status = TrackStatus::tracked;
  command.hold = false;
  command.state = CommandState::following;
  command.targets.emplace();
  command.targets->T_base_hand.translation() = Eigen::Vector3d(0.5, 0, 0.5);
  return command;
}

inline RobotCommand lost_command(int64_t timestamp_us) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = timestamp_us;
  return command;
}

inline void set_joint(RobotTargets& targets, ShadowJoint joint, double angle) {
  targets.hand.joints[joint] = angle;
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
    targets.hand.actuators[a] = targets.hand.joints[info.joint];
    if (info.coupled_joint) targets.hand.actuators[a] += targets.hand.joints[*info.coupled_joint];
  }
}

}  // namespace glovebench
