#pragma once

#include <string>

namespace glovebench {

/// Where a participant of DDS talks, and as whom.
struct DdsAccess {
  /// The network interface. Empty: what CYCLONEDDS_URI says, if that is set; otherwise loopback alone.
  std::string interface;
  /// Folder of keys (`glovebench robot-server keys`) for DDS Security; empty: without.
  std::string security;
  std::string role;  ///< whose keys (`security_roles`)

  bool operator==(const DdsAccess&) const = default;
};

/// Topics as DDS knows them: ROS 2 puts `rt/` before its own names.
struct Topics {
  const char* hand;          ///< trajectory_msgs/JointTrajectory of the fingers
  const char* wrist;         ///< trajectory_msgs/JointTrajectory of the wrist
  const char* arm;           ///< geometry_msgs/PoseStamped of the wrist in the arm's base frame
  const char* joint_states;  ///< sensor_msgs/JointState: where the joints are told to be
};

namespace topics {

/// Between `track --robot` and `robot-server`. Nothing else listens there.
inline constexpr Topics kOwn = {"rt/glovebench/hand/command", "rt/glovebench/wrist/command",
                                "rt/glovebench/arm/command/pose", "rt/glovebench/joint_states"};
/// Of a robot's own controllers.
inline constexpr Topics kController = {"rt/rh_trajectory_controller/command",
                                       "rt/rh_wr_trajectory_controller/command", "rt/pa10/command/pose",
                                       "rt/joint_states"};
/// sensor_msgs/JointState: where the robot's driver measures the joints.
inline constexpr const char* kMeasuredJointStates = "rt/glovebench/measured_joint_states";

}  // namespace topics
}  // namespace glovebench
