#pragma once

/// Topics as DDS knows them: ROS 2 puts `rt/` before its own names.
namespace glovebench::topics {

inline constexpr const char* kHand = "rt/rh_trajectory_controller/command";
inline constexpr const char* kWrist = "rt/rh_wr_trajectory_controller/command";
inline constexpr const char* kArm = "rt/pa10/command/pose";
inline constexpr const char* kJointStates = "rt/joint_states";

}  // namespace glovebench::topics
