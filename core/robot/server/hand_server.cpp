#include "core/robot/server/hand_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/angles.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

/// This server has no arm: its hand stays at one place, in the middle of the workspace.
RobotTargets standing(const CommandLimits& limits, const StartPlace& start) {
  if (start.joints.size() != kShadowJointCount)
    throw Error(start.source, "joints", fmt::format("{}", start.joints.size()),
                fmt::format("{}", kShadowJointCount));
  RobotTargets targets;
  std::array<double, kShadowJointCount>& joints = targets.hand.joints;
  for (size_t j = 0; j < joints.size(); ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    joints[j] = start_angle(start.joints[j], info.min_deg, info.max_deg, start, hand_joint_names()[j]);
  }
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    double& distal = joints[*info.coupled_joint];
    distal = start_distal(distal, joints[info.joint], start, hand_joint_names()[*info.coupled_joint]);
  }
  make_actuators(targets.hand);
  targets.T_base_hand.translation() = (limits.workspace_min + limits.workspace_max) / 2;
  return targets;
}

const std::vector<std::string>& names_of(HandTopic topic) {
  return topic == HandTopic::wrist ? wrist_trajectory_names() : hand_trajectory_names();
}

int first_joint(HandTopic topic) {
  return topic == HandTopic::wrist ? kWRJ1 : 0;
}

}  // namespace

std::vector<JointMotion> HandServer::joint_motions(const CommandLimits& limits) {
  std::vector<JointMotion> motions;
  for (const ShadowJointInfo& info : shadow_joint_infos())
    motions.push_back(
        {radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg), limits.hand_joint_speed});
  return motions;
}

HandServer::HandServer(const CommandLimits& limits, const StartPlace& start)
    : guard_(limits, GuardedPart::hand), stream_(limits, 2), goal_(standing(limits, start)) {
  guard_.start_from(goal_);
  last_.position.assign(goal_.hand.joints.begin(), goal_.hand.joints.end());
}

Receipt HandServer::receive(HandTopic topic, const ros::JointTrajectory& message, const Arrival& arrival) {
  if (stream_.ignores(arrival.sender, arrival.now_us)) return Receipt::foreign;
  const auto number = static_cast<size_t>(topic);
  const JointsRead read = read_joints(message, names_of(topic));
  const Receipt receipt = stream_.receive(arrival, static_cast<int>(number), message.stamp, read.receipt);
  if (receipt != Receipt::accepted) return receipt;
  drop_old_goals(arrival.now_us);
  std::ranges::copy(read.positions, goal_.hand.joints.begin() + first_joint(topic));
  wanted_[number] = changed_ = true;
  return receipt;
}

/// Joints whose goal is followed no more shall stay where they are. True if there are some.
bool HandServer::drop_old_goals(int64_t now_us) {
  bool dropped = false;
  for (const HandTopic topic : {HandTopic::fingers, HandTopic::wrist}) {
    const auto number = static_cast<size_t>(topic);
    if (!wanted_[number] || stream_.is_current(static_cast<int>(number), now_us)) continue;
    const auto first = static_cast<std::ptrdiff_t>(first_joint(topic));
    std::copy_n(last_.position.begin() + first, names_of(topic).size(), goal_.hand.joints.begin() + first);
    wanted_[number] = false;
    dropped = true;
  }
  return dropped;
}

RobotState HandServer::tick(const ServerTime& now, bool may_move) {
  stream_.tick(now.clock_us, now.system_us);
  changed_ |= drop_old_goals(now.clock_us);
  const bool follows = may_move && ticked_ && stream_.is_current(now.clock_us);
  std::optional<RobotCommand> sent;
  // The first tick only says what time it is: from there the guard knows how far a joint may move.
  if (!follows || changed_) {
    make_actuators(goal_.hand);
    RobotCommand command;
    command.frame_timestamp_us = command.timestamp_us = now.clock_us;
    command.status = TrackStatus::tracked;
    command.hold = !follows;
    command.state = CommandState::following;
    command.targets = goal_;
    sent = guard_.guard(command, now.clock_us);
    changed_ = !follows;
  } else {
    sent = guard_.tick(now.clock_us);
  }
  if (!sent) throw std::logic_error("a tick of the hand that is not after the last one");
  RobotState state{now.clock_us, sent->state, {}, std::vector<double>(kShadowJointCount, 0.0)};
  state.position.assign(sent->targets->hand.joints.begin(), sent->targets->hand.joints.end());
  for (size_t j = 0; ticked_ && j < state.position.size(); ++j)
    state.velocity[j] =
        (state.position[j] - last_.position[j]) / (static_cast<double>(now.clock_us - last_.clock_us) * 1e-6);
  ticked_ = true;
  last_ = state;
  return state;
}

}  // namespace glovebench
