#include "core/adapters/dds/command_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

constexpr uint32_t kNanosecondsOfASecond = 1'000'000'000;
constexpr double kMessageUnitTolerance = 1e-3;  // as tf2 admits it
constexpr int kWristJointCount = 2;             // the last ones of ShadowJoint
static_assert(kWRJ1 == kShadowJointCount - 2 && kWRJ2 == kShadowJointCount - 1);

bool is_time(const ros::Time& time) { return time.sec >= 0 && time.nanosec < kNanosecondsOfASecond; }

ros::JointTrajectory trajectory(const RobotCommand& command, const std::vector<std::string>& names, int first,
                                int64_t time_us) {
  ros::JointTrajectory message;
  message.stamp = ros_time(command.frame_timestamp_us);
  message.joint_names = names;
  ros::JointTrajectoryPoint& point = message.points.emplace_back();
  point.time_from_start = ros_time(time_us);
  for (size_t j = 0; j < names.size(); ++j) {
    const double angle = command.targets->hand.joints.at(static_cast<size_t>(first) + j);
    if (!std::isfinite(angle)) throw Error("robot command", names[j], fmt::format("{}", angle), "a finite number");
    point.positions.push_back(angle);
  }
  return message;
}

}  // namespace

const std::vector<std::string>& hand_joint_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> made;
    for (const ShadowJointInfo& info : shadow_joint_infos()) made.push_back("rh_" + std::string(info.name));
    return made;
  }();
  return names;
}

const std::vector<std::string>& hand_trajectory_names() {
  static const std::vector<std::string> names(hand_joint_names().begin(),
                                              hand_joint_names().end() - kWristJointCount);
  return names;
}

const std::vector<std::string>& wrist_trajectory_names() {
  static const std::vector<std::string> names(hand_joint_names().end() - kWristJointCount,
                                              hand_joint_names().end());
  return names;
}

const std::vector<std::string>& arm_joint_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> made;
    for (const ArmJointInfo& info : arm_joint_infos()) made.emplace_back(info.name);
    return made;
  }();
  return names;
}

ros::Time ros_time(int64_t time_us) {
  constexpr int64_t kSecond = 1'000'000;
  if (time_us < 0 || time_us / kSecond > std::numeric_limits<int32_t>::max())
    throw Error("robot command", "time", fmt::format("{} us", time_us), "0 to 2^31 s");
  return {static_cast<int32_t>(time_us / kSecond), static_cast<uint32_t>(time_us % kSecond * 1000)};
}

int64_t nanoseconds(const ros::Time& time) { return int64_t{time.sec} * kNanosecondsOfASecond + time.nanosec; }

int64_t time_to_targets_us(double longest_step_s) {
  // After a time t a controller still has at most the rest of this time to go, and the next targets are at most
  // min(t, longest_step_s) farther. Where a motion starts was measured at most kMeasuredAgeUs ago.
  return std::max(static_cast<int64_t>(std::ceil(longest_step_s * 1e6)), kMeasuredAgeUs);
}

ros::JointTrajectory hand_message(const RobotCommand& command, int64_t time_us) {
  return trajectory(command, hand_trajectory_names(), 0, time_us);
}

ros::JointTrajectory wrist_message(const RobotCommand& command, int64_t time_us) {
  return trajectory(command, wrist_trajectory_names(), kWRJ1, time_us);
}

ros::PoseStamped pose_message(const RobotCommand& command) {
  const Eigen::Isometry3d T_base_wrist =
      command.targets->T_base_hand * shadow_T_wrist_hand(command.targets->hand.joints).inverse();
  if (!T_base_wrist.matrix().allFinite())
    throw Error("robot command", "T_base_hand or wrist", "a value that is not finite", "a finite pose");
  const Eigen::Vector3d p = T_base_wrist.translation();
  Eigen::Quaterniond q(T_base_wrist.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();  // q and -q are one rotation: send one of them
  return {.stamp = ros_time(command.frame_timestamp_us),
          .frame_id = kBaseFrame,
          .x = p.x(),
          .y = p.y(),
          .z = p.z(),
          .qx = q.x(),
          .qy = q.y(),
          .qz = q.z(),
          .qw = q.w()};
}

JointsRead read_joints(const ros::JointTrajectory& message, const std::vector<std::string>& names) {
  if (!is_time(message.stamp)) return {Receipt::bad_time, {}};
  if (message.joint_names.size() != names.size()) return {Receipt::wrong_joints, {}};
  if (message.points.size() != 1) return {Receipt::wrong_points, {}};
  const ros::JointTrajectoryPoint& point = message.points.front();
  if (!is_time(point.time_from_start)) return {Receipt::bad_time, {}};
  if (point.positions.size() != names.size()) return {Receipt::wrong_points, {}};
  std::vector<double> positions;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(message.joint_names, name);  // as many as names: each then stands once
    if (found == message.joint_names.end()) return {Receipt::wrong_joints, {}};
    positions.push_back(point.positions[static_cast<size_t>(found - message.joint_names.begin())]);
    if (!std::isfinite(positions.back())) return {Receipt::not_finite, {}};
  }
  return {Receipt::accepted, std::move(positions)};
}

PoseRead read_pose(const ros::PoseStamped& message) {
  if (!is_time(message.stamp)) return {.receipt = Receipt::bad_time};
  if (message.frame_id != kBaseFrame) return {.receipt = Receipt::wrong_frame};
  const Eigen::Vector3d p(message.x, message.y, message.z);
  const Eigen::Quaterniond q(message.qw, message.qx, message.qy, message.qz);
  if (!p.allFinite() || !q.coeffs().allFinite()) return {.receipt = Receipt::not_finite};
  if (!(std::abs(q.norm() - 1) < kMessageUnitTolerance)) return {.receipt = Receipt::not_rotation};
  return {.receipt = Receipt::accepted, .T_base_wrist = Eigen::Translation3d(p) * q.normalized()};
}

}  // namespace glovebench
