#pragma once

#include <string>

namespace glovebench {

/// How a DDS participant communicates.
struct DdsAccess {
  /// Network interface. Empty: as CYCLONEDDS_URI says, or loopback if it is not set.
  std::string interface;
  /// Folder of keys for DDS Security (`glovebench robot-server keys`); empty: none.
  std::string security;
  std::string role;  ///< whose keys (`security_roles`)

  bool operator==(const DdsAccess&) const = default;
};

/// Topics in DDS, with the `rt/` that ROS 2 puts before its names.
struct Topics {
  const char* hand;          ///< trajectory_msgs/JointTrajectory
  const char* wrist;         ///< trajectory_msgs/JointTrajectory
  const char* arm;           ///< geometry_msgs/PoseStamped of the wrist
  const char* joint_states;  ///< sensor_msgs/JointState: targets
};

namespace topics {

/// From `track --robot` to `robot-server`.
inline constexpr Topics kOwn = {"rt/glovebench/hand/command", "rt/glovebench/wrist/command",
                                "rt/glovebench/arm/command/pose", "rt/glovebench/joint_states"};
/// To a robot's own controllers.
inline constexpr Topics kController = {"rt/rh_trajectory_controller/command",
                                       "rt/rh_wr_trajectory_controller/command", "rt/pa10/command/pose",
                                       "rt/joint_states"};
/// sensor_msgs/JointState measured by the robot's driver.
inline constexpr const char* kMeasuredJointStates = "rt/glovebench/measured_joint_states";

}  // namespace topics
}  // namespace glovebench
