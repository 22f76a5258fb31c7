#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"
#include "core/robot/robot_command.h"

/// ROS messages, unchecked.
namespace glovebench::ros {

/// builtin_interfaces/Time and Duration
struct Time {
  int32_t sec = 0;
  uint32_t nanosec = 0;
};

/// trajectory_msgs/JointTrajectoryPoint with positions only
struct JointTrajectoryPoint {
  std::vector<double> positions;  ///< rad
  Time time_from_start;
};

/// trajectory_msgs/JointTrajectory
struct JointTrajectory {
  Time stamp;
  std::string frame_id;
  std::vector<std::string> joint_names;
  std::vector<JointTrajectoryPoint> points;
};

/// geometry_msgs/PoseStamped
struct PoseStamped {
  Time stamp;
  std::string frame_id;
  double x = 0, y = 0, z = 0;  ///< m
  double qx = 0, qy = 0, qz = 0, qw = 1;
};

/// sensor_msgs/JointState without efforts
struct JointState {
  Time stamp;
  std::vector<std::string> name;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s
};

}  // namespace glovebench::ros

namespace glovebench {

/// Outcomes in the order of the checks.
enum class Receipt {
  foreign,       ///< another sender owns the stream
  bad_time,      ///< before 1970, or nanoseconds of 1 s or more
  wrong_joints,  ///< not the topic's joints
  wrong_points,  ///< not one point with one position per joint
  wrong_frame,
  not_finite,
  not_rotation,  ///< no unit quaternion
  stale,         ///< older than `silence_s`, or within 0.1 s of a gap or a clock's jump
  starting,      ///< its stream began less than 0.2 s ago
  went_back,     ///< stamp not after the sender's last one
  accepted,
};
constexpr auto names_of(Receipt) {
  return std::to_array<std::string_view>({"foreign", "bad_time", "wrong_joints", "wrong_points", "wrong_frame",
                                          "not_finite", "not_rotation", "stale", "starting", "went_back",
                                          "accepted"});
}
static_assert(kCountOf<Receipt> == static_cast<int>(Receipt::accepted) + 1, "each value has a name");

struct RobotState {
  int64_t clock_us = 0;  ///< monotonic
  CommandState state = CommandState::stopped;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s, since the last state
};

inline constexpr const char* kBaseFrame = "base_link";

/// ROS names (`rh_FFJ1` ...). `hand_joint_names` has all, by ShadowJoint.
const std::vector<std::string>& hand_trajectory_names();
const std::vector<std::string>& wrist_trajectory_names();
const std::vector<std::string>& hand_joint_names();
const std::vector<std::string>& arm_joint_names();

/// Throws: Error for times outside 0 to 2^31 s.
ros::Time ros_time(int64_t time_us);
int64_t nanoseconds(const ros::Time& time);

/// A trusted measured state is this near to now.
inline constexpr int64_t kMeasuredAgeUs = 100'000;

/// Time for a straight path to the targets within the guard's speeds.
int64_t time_to_targets_us(double longest_step_s);

/// The targets, which must exist, as one point to reach in `time_us`. The stamp is the frame's time.
/// Throws: Error if a target is not finite.
ros::JointTrajectory hand_message(const RobotCommand& command, int64_t time_us);
ros::JointTrajectory wrist_message(const RobotCommand& command, int64_t time_us);
/// The pose of WRJ2 in kBaseFrame.
ros::PoseStamped pose_message(const RobotCommand& command);

struct JointsRead {
  Receipt receipt = Receipt::accepted;
  std::vector<double> positions;  ///< rad, by `names`; empty unless accepted
};
JointsRead read_joints(const ros::JointTrajectory& message, const std::vector<std::string>& names);
struct PoseRead {
  Receipt receipt = Receipt::accepted;
  Eigen::Isometry3d T_base_wrist = Eigen::Isometry3d::Identity();
};
PoseRead read_pose(const ros::PoseStamped& message);

}  // namespace glovebench
