#include "core/adapters/dds/server/robot_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/error.h"
#include "core/robot/guarded_motion.h"

namespace glovebench {
namespace {

constexpr double kWorkspaceRounding = 1e-4;  // m: 1e-7 of the arm's angles in a log, 1e-5 of their solver

const std::vector<std::string>& names_of(RobotTopic topic) {
  return topic == RobotTopic::wrist ? wrist_trajectory_names() : hand_trajectory_names();
}

int first_joint(RobotTopic topic) { return topic == RobotTopic::wrist ? kWRJ1 : 0; }

std::string text(const Eigen::Vector3d& p) { return fmt::format("({:.6g} {:.6g} {:.6g})", p.x(), p.y(), p.z()); }

double start_angle(double angle, double min_deg, double max_deg, const StartPlace& start, std::string_view joint) {
  const double angle_deg = degrees_from_radians(angle), tolerance_deg = degrees_from_radians(start.tolerance);
  if (!(angle_deg >= min_deg - tolerance_deg && angle_deg <= max_deg + tolerance_deg))
    throw Error(start.source, std::string(joint), fmt::format("{} degrees", angle_deg),
                fmt::format("{} to {}", min_deg, max_deg));
  return std::clamp(angle, radians_from_degrees(min_deg), radians_from_degrees(max_deg));
}

/// J1 of a finger at the start, not above its J2.
double start_distal(double distal, double proximal, const StartPlace& start, std::string_view joint) {
  if (!(distal <= proximal + start.tolerance))
    throw Error(start.source, std::string(joint), fmt::format("{} degrees", degrees_from_radians(distal)),
                fmt::format("at most the {} of the joint before it", degrees_from_radians(proximal)));
  return std::min(distal, proximal);
}

std::array<double, kShadowJointCount> start_hand(const StartPlace& start) {
  std::array<double, kShadowJointCount> joints;
  for (size_t j = 0; j < joints.size(); ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    joints[j] = start_angle(start.joints[j], info.min_deg, info.max_deg, start, hand_joint_names()[j]);
  }
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    double& distal = joints[*info.coupled_joint];
    distal = start_distal(distal, joints[info.joint], start, hand_joint_names()[*info.coupled_joint]);
  }
  return joints;
}

/// The arm's joints are the last ones.
ArmJoints start_arm(const StartPlace& start) {
  ArmJoints joints;
  for (size_t j = 0; j < joints.size(); ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    joints[j] = start_angle(start.joints[start.joints.size() - joints.size() + j], info.min_deg, info.max_deg,
                            start, info.name);
  }
  return joints;
}

/// Where the joints stand. A hand without an arm stays at one place, in the middle of the workspace.
RobotTargets standing(const CommandLimits& limits, const ServedRobot& robot, const StartPlace& start) {
  if (const size_t count = robot.names().size(); start.joints.size() != count)
    throw Error(start.source, "joints", fmt::format("{}", start.joints.size()), fmt::format("{}", count));
  RobotTargets targets;
  targets.T_base_hand.translation() = (limits.workspace_min + limits.workspace_max) / 2;
  if (robot.hand) targets.hand.joints = start_hand(start);
  make_actuators(targets.hand);
  if (!robot.arm) return targets;
  targets.arm = start_arm(start);
  targets.T_base_hand = carried_pose(robot.arm->T_base_wrist(*targets.arm), targets.hand.joints, robot.part());
  const Eigen::Vector3d place = targets.T_base_hand.translation(),
                        inside = place_in_workspace(targets, limits, robot.part());
  if (!((inside - place).norm() <= kWorkspaceRounding))
    throw Error(start.source, robot.hand ? "hand on the arm" : "wrist of the arm", text(place) + " m",
                fmt::format("a place in the workspace, with room for the fingertips: {} to {}",
                            text(limits.workspace_min), text(limits.workspace_max)));
  targets.T_base_hand.translation() = inside;
  return targets;
}

}  // namespace

std::string_view to_string(RobotTopic topic) {
  static constexpr std::array<std::string_view, kRobotTopicCount> names = {"fingers", "wrist", "pose"};
  return names.at(static_cast<size_t>(topic));
}

GuardedPart ServedRobot::part() const {
  if (!arm) return GuardedPart::hand;
  return hand ? GuardedPart::robot : GuardedPart::arm;
}

std::string ServedRobot::name() const { return hand && arm ? "hand and arm" : hand ? "hand" : "arm"; }

std::vector<std::string> ServedRobot::names() const {
  std::vector<std::string> names;
  if (hand) names = hand_joint_names();
  if (arm) names.insert(names.end(), arm_joint_names().begin(), arm_joint_names().end());
  return names;
}

std::vector<double> ServedRobot::at_rest() const {
  std::vector<double> joints(hand ? kShadowJointCount : 0, 0.0);
  if (arm) joints.insert(joints.end(), kArmAtRest.begin(), kArmAtRest.end());
  return joints;
}

std::vector<JointMotion> ServedRobot::motions(const CommandLimits& limits) const {
  std::vector<JointMotion> motions;
  const auto add = [&](const auto& info, double speed) {
    motions.push_back({radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg), speed});
  };
  if (hand)
    for (const ShadowJointInfo& info : shadow_joint_infos()) add(info, limits.hand_joint_speed);
  if (arm)
    for (const ArmJointInfo& info : arm_joint_infos())
      add(info, limits.arm_speed_share * radians_from_degrees(info.max_speed_deg_s));
  return motions;
}

RobotServer::RobotServer(const CommandLimits& limits, const ServedRobot& robot, const StartPlace& start)
    : robot_(robot),
      guard_(limits, robot.part(), robot.arm),
      stream_(limits, kRobotTopicCount),
      stands_(standing(guard_.limits(), robot, start)),
      hand_goal_(stands_.hand.joints) {
  guard_.start_from(stands_);
  last_.position = joints_of(stands_);
}

std::vector<double> RobotServer::joints_of(const RobotTargets& targets) const {
  std::vector<double> joints;
  if (robot_.hand) joints.assign(targets.hand.joints.begin(), targets.hand.joints.end());
  if (robot_.arm) joints.insert(joints.end(), targets.arm->begin(), targets.arm->end());
  return joints;
}

Receipt RobotServer::receive(RobotTopic topic, const ros::JointTrajectory& message, const Arrival& arrival) {
  if (stream_.ignores(arrival.sender, arrival.now_us)) return Receipt::foreign;
  const JointsRead read = read_joints(message, names_of(topic));
  const Receipt receipt = judge(topic, message.stamp, read.receipt, arrival);
  if (receipt == Receipt::accepted) std::ranges::copy(read.positions, hand_goal_.begin() + first_joint(topic));
  return receipt;
}

Receipt RobotServer::receive(RobotTopic topic, const ros::PoseStamped& message, const Arrival& arrival) {
  if (stream_.ignores(arrival.sender, arrival.now_us)) return Receipt::foreign;
  const PoseRead read = read_pose(message);
  const Receipt receipt = judge(topic, message.stamp, read.receipt, arrival);
  if (receipt == Receipt::accepted) T_base_wrist_goal_ = read.T_base_wrist;
  return receipt;
}

/// An accepted message becomes the goal of its topic.
Receipt RobotServer::judge(RobotTopic topic, const ros::Time& stamp, Receipt found, const Arrival& arrival) {
  const Receipt receipt = stream_.receive(arrival, static_cast<int>(topic), stamp, found);
  if (receipt != Receipt::accepted) return receipt;
  drop_old_goals(arrival.now_us);
  wanted_[static_cast<size_t>(topic)] = changed_ = true;
  return receipt;
}

/// Joints whose goal has ended shall stay where they are. Returns whether there are any.
bool RobotServer::drop_old_goals(int64_t now_us) {
  bool dropped = false;
  for (const RobotTopic topic : {RobotTopic::fingers, RobotTopic::wrist, RobotTopic::pose}) {
    bool& wanted = wanted_[static_cast<size_t>(topic)];
    if (!wanted || stream_.is_current(static_cast<int>(topic), now_us)) continue;
    wanted = false;
    dropped = true;
    if (topic == RobotTopic::pose) continue;
    const auto first = static_cast<std::ptrdiff_t>(first_joint(topic));
    std::copy_n(stands_.hand.joints.begin() + first, names_of(topic).size(), hand_goal_.begin() + first);
  }
  return dropped;
}

RobotTargets RobotServer::goal() const {
  RobotTargets targets = stands_;  // the arm's joints stay unless a pose is wanted
  targets.hand.joints = hand_goal_;
  make_actuators(targets.hand);
  if (!robot_.arm) return targets;
  Eigen::Isometry3d T_base_wrist = robot_.arm->T_base_wrist(*targets.arm);
  if (wanted_[static_cast<size_t>(RobotTopic::pose)]) {
    T_base_wrist = T_base_wrist_goal_;
    targets.arm.reset();
  }
  std::array<double, kShadowJointCount> joints = hand_goal_;  // the guard moves them into their limits
  for (const ShadowJoint j : {kWRJ1, kWRJ2})
    joints[j] = std::clamp(joints[j], radians_from_degrees(shadow_joint_infos()[j].min_deg),
                           radians_from_degrees(shadow_joint_infos()[j].max_deg));
  targets.T_base_hand = carried_pose(T_base_wrist, joints, robot_.part());
  return targets;
}

RobotCommand RobotServer::limited(int64_t now_us, bool follows) {
  std::optional<RobotCommand> sent;
  if (!follows || changed_) {
    RobotCommand command;
    command.frame_timestamp_us = command.timestamp_us = now_us;
    command.status = TrackStatus::tracked;
    command.hold = !follows;
    command.state = CommandState::following;
    command.targets = goal();
    sent = guard_.guard(command, now_us);
    changed_ = !follows;
  } else {
    sent = guard_.tick(now_us);
  }
  if (!sent) throw std::logic_error("a tick of the robot that is not after the last one");
  return *sent;
}

RobotState RobotServer::tick(const ServerTime& now, bool may_move) {
  stream_.tick(now);
  changed_ |= drop_old_goals(now.clock_us);
  // The first tick only sets the time from which the guard limits motion.
  const bool follows = may_move && ticked_ && stream_.is_current(now.clock_us);
  const RobotCommand sent = limited(now.clock_us, follows);
  stands_ = *sent.targets;
  RobotState state{now.clock_us, sent.state, joints_of(stands_), {}};
  const double elapsed = static_cast<double>(now.clock_us - last_.clock_us) * 1e-6;
  for (size_t j = 0; j < state.position.size(); ++j)
    state.velocity.push_back(ticked_ ? (state.position[j] - last_.position[j]) / elapsed : 0.0);
  ticked_ = true;
  return last_ = state;
}

}  // namespace glovebench
