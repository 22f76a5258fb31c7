#pragma once

#include <string>

namespace glovebench {

struct DdsAccess {
  /// Empty: CYCLONEDDS_URI's, or loopback if that is not set.
  std::string interface;
  /// Folder of keys (`glovebench robot-server keys`); empty: no DDS Security.
  std::string security;
  std::string role;  ///< whose keys (`security_roles`)

  bool operator==(const DdsAccess&) const = default;
};

/// DDS names of topics: ROS 2 puts `rt/` before its own.
struct Topics {
  const char* hand;          ///< JointTrajectory
  const char* wrist;         ///< JointTrajectory
  const char* arm;           ///< PoseStamped of the wrist
  const char* joint_states;  ///< JointState, as commanded
};

namespace topics {

/// From `track --robot` to `robot-server`.
inline constexpr Topics kOwn = {"rt/glovebench/hand/command", "rt/glovebench/wrist/command",
                                "rt/glovebench/arm/command/pose", "rt/glovebench/joint_states"};
/// To a robot's own controllers.
inline constexpr Topics kController = {"rt/rh_trajectory_controller/command",
                                       "rt/rh_wr_trajectory_controller/command", "rt/pa10/command/pose",
                                       "rt/joint_states"};
/// JointState, as a robot's driver measures.
inline constexpr const char* kMeasuredJointStates = "rt/glovebench/measured_joint_states";

}  // namespace topics
}  // namespace glovebench
