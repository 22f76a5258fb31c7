#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"
#include "core/robot/robot_command.h"

/// The messages of ROS that hand and arm speak, as plain structs: what any middleware brings, unchecked.
namespace glovebench::ros {

/// builtin_interfaces/Time and Duration
struct Time {
  int32_t sec = 0;
  uint32_t nanosec = 0;
};

/// trajectory_msgs/JointTrajectoryPoint. Velocities, accelerations and efforts are neither sent nor heeded.
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

/// sensor_msgs/JointState. Efforts are not known and left out.
struct JointState {
  Time stamp;
  std::vector<std::string> name;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s
};

}  // namespace glovebench::ros

namespace glovebench {

/// What became of a message that a server of the robot received, in the order in which it is judged.
enum class Receipt {
  foreign,       ///< another sender owns the stream
  bad_time,      ///< a time before 1970, or with a second and more of nanoseconds
  wrong_joints,  ///< its joints are not exactly those of the topic, each once, in any order
  wrong_points,  ///< not exactly one point, or not one position for each joint
  wrong_frame,   ///< a pose in another frame than the arm's base
  not_finite,    ///< a position is no finite number
  not_rotation,  ///< the quaternion has not the length 1
  stale,         ///< older than the time of silence, or it waited through a gap
  starting,      ///< its stream has not yet shown for 0.2 s that it is a live one
  went_back,     ///< its stamp is not after that of its sender's last message
  accepted,
};
constexpr auto names_of(Receipt) {
  return std::to_array<std::string_view>({"foreign", "bad_time", "wrong_joints", "wrong_points", "wrong_frame",
                                          "not_finite", "not_rotation", "stale", "starting", "went_back",
                                          "accepted"});
}
static_assert(kCountOf<Receipt> == static_cast<int>(Receipt::accepted) + 1, "each value has a name");

/// What a server of the robot sends to its joints, and so where they stand.
struct RobotState {
  int64_t clock_us = 0;  ///< of the server, which does not go back
  CommandState state = CommandState::stopped;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s, since the state before; zero at first
};

/// The frame in which the arm takes poses.
inline constexpr const char* kBaseFrame = "base_link";

/// Names as ROS knows them, `rh_FFJ1` ...: the 22 joints that the hand's controller takes, the two of the wrist's,
/// and all 24 in the order of ShadowJoint.
const std::vector<std::string>& hand_trajectory_names();
const std::vector<std::string>& wrist_trajectory_names();
const std::vector<std::string>& hand_joint_names();
/// The arm's, from base to flange.
const std::vector<std::string>& arm_joint_names();

/// Microseconds since 1970, or of a recording. Throws Error unless ROS has such a time: from 0 to 2^31 seconds.
ros::Time ros_time(int64_t time_us);
/// Of any ros::Time.
int64_t nanoseconds(const ros::Time& time);

/// Older than this, a measured state is not believed; nor is one that is farther ahead in time.
inline constexpr int64_t kMeasuredAgeUs = 100'000;

/// How long a controller shall take to a command's targets. One that goes there straight from where it is then
/// keeps the guard's limits of speed, whenever commands come: it is never farther away than it gets in that time.
/// For after a time t it still has at most the rest to go to the last targets, and the next ones are at most min(t,
/// `longest_step_s`) farther; and where a motion starts was measured at most kMeasuredAgeUs ago.
int64_t time_to_targets_us(double longest_step_s);

/// A command's targets, which must be there, as the controllers of hand and wrist take them: one point, to be
/// reached `time_us` later; stamped with the time of the frame. Throws Error if a target is not finite.
ros::JointTrajectory hand_message(const RobotCommand& command, int64_t time_us);
ros::JointTrajectory wrist_message(const RobotCommand& command, int64_t time_us);
/// Where the arm shall take the wrist: the frame of WRJ2, which is fixed to the forearm (`shadow_T_wrist_hand`), so
/// that the hand gets to T_base_hand when its wrist has bent, too. In kBaseFrame, stamped alike.
ros::PoseStamped pose_message(const RobotCommand& command);

/// A message as a server reads it, whatever is in it.
struct JointsRead {
  Receipt receipt = Receipt::accepted;
  std::vector<double> positions;  ///< rad, in the order of `names`; empty unless accepted
};
JointsRead read_joints(const ros::JointTrajectory& message, const std::vector<std::string>& names);
struct PoseRead {
  Receipt receipt = Receipt::accepted;
  Eigen::Isometry3d T_base_wrist = Eigen::Isometry3d::Identity();
};
PoseRead read_pose(const ros::PoseStamped& message);

}  // namespace glovebench
