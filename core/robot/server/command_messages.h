#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/robot/robot_command.h"
#include "core/robot/server/receipt.h"
#include "core/robot/server/ros_messages.h"

namespace glovebench {

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

/// A command's targets, which must be there, as the controllers of hand and wrist take them: one point, to be
/// reached `period_us` later; stamped with the time of the frame. Throws Error if a target is not finite.
ros::JointTrajectory hand_message(const RobotCommand& command, int64_t period_us);
ros::JointTrajectory wrist_message(const RobotCommand& command, int64_t period_us);
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
