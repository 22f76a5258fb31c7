#pragma once

#include <string>

namespace glovebench {

struct DdsAccess {
  /// Empty: the interface of CYCLONEDDS_URI, else loopback.
  std::string interface;
  /// Folder of keys. Empty: no DDS Security.
  std::string security;
  std::string role;  ///< one of `security_roles`

  bool operator==(const DdsAccess&) const = default;
};

/// Topic names, with ROS 2's prefix `rt/`. `hand` and `wrist`: JointTrajectory.
struct Topics {
  const char* hand;
  const char* wrist;
  const char* arm;           ///< PoseStamped of the wrist
  const char* joint_states;  ///< JointState, commanded
};

namespace topics {

/// From `track` to `robot-server`.
inline constexpr Topics kOwn = {"rt/glovebench/hand/command", "rt/glovebench/wrist/command",
                                "rt/glovebench/arm/command/pose", "rt/glovebench/joint_states"};
/// To a robot's own controllers.
inline constexpr Topics kController = {"rt/rh_trajectory_controller/command",
                                       "rt/rh_wr_trajectory_controller/command", "rt/pa10/command/pose",
                                       "rt/joint_states"};
/// JointState by the robot's driver.
inline constexpr const char* kMeasuredJointStates = "rt/glovebench/measured_joint_states";

}  // namespace topics
}  // namespace glovebench
