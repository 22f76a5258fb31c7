#include "core/robot/server/hand_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/base/error.h"
#include "core/robot/server/start_place.h"

namespace glovebench {
namespace {

/// This server has no arm: its hand stays at one place, in the middle of the workspace.
RobotTargets standing(const CommandLimits& limits, const std::vector<double>& start, const std::string& source) {
  if (start.size() != kShadowJointCount)
    throw Error(source, "joints", fmt::format("{}", start.size()), fmt::format("{}", kShadowJointCount));
  RobotTargets targets;
  std::array<double, kShadowJointCount>& joints = targets.hand.joints;
  for (size_t j = 0; j < joints.size(); ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    joints[j] = start_angle(start[j], info.min_deg, info.max_deg, source, hand_joint_names()[j]);
  }
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    double& distal = joints[*info.coupled_joint];
    distal = start_distal(distal, joints[info.joint], source, hand_joint_names()[*info.coupled_joint]);
  }
  make_actuators(targets.hand);
  targets.T_base_hand.translation() = (limits.workspace_min + limits.workspace_max) / 2;
  return targets;
}

}  // namespace

HandServer::HandServer(const CommandLimits& limits, const std::vector<double>& start, const std::string& source)
    : guard_(limits, GuardedPart::hand), gate_(limits.stop_after_s), goal_(standing(limits, start, source)) {
  guard_.start_from(goal_);
  last_.position.assign(goal_.hand.joints.begin(), goal_.hand.joints.end());
}

bool HandServer::ignores(uint64_t sender, int64_t now_us) {
  const bool foreign = gate_.is_foreign(sender, now_us);
  receipts_[static_cast<size_t>(Receipt::foreign)] += foreign;
  return foreign;
}

Receipt HandServer::receive(uint64_t sender, HandTopic topic, const ros::JointTrajectory& message, int64_t now_us) {
  if (ignores(sender, now_us)) return Receipt::foreign;
  const bool wrist = topic == HandTopic::wrist;
  const JointsRead read = read_joints(message, wrist ? wrist_trajectory_names() : hand_trajectory_names());
  Receipt receipt = read.receipt;
  if (receipt == Receipt::accepted) receipt = gate_.admit(sender, wrist ? 1 : 0, message.stamp, now_us);
  ++receipts_[static_cast<size_t>(receipt)];
  if (receipt != Receipt::accepted) return receipt;
  // What another sender wanted of the other joints, or this one before it fell silent, is wanted no more.
  if (std::exchange(sender_, sender) != sender || (last_.state != CommandState::following && !received_))
    std::ranges::copy(last_.position, goal_.hand.joints.begin());
  std::ranges::copy(read.positions, goal_.hand.joints.begin() + (wrist ? kWRJ1 : 0));
  received_ = true;
  return receipt;
}

RobotState HandServer::tick(int64_t now_us) {
  std::optional<RobotCommand> sent;
  // The first tick only says what time it is: from there the guard knows how far a joint may move.
  if (ticked_ && std::exchange(received_, false)) {
    make_actuators(goal_.hand);
    RobotCommand command;
    command.frame_timestamp_us = command.timestamp_us = now_us;
    command.status = TrackStatus::tracked;
    command.hold = false;
    command.state = CommandState::following;
    command.targets = goal_;
    sent = guard_.guard(command, now_us);
  } else {
    sent = guard_.tick(now_us);
  }
  if (!sent) throw std::logic_error("a tick of the hand that is not after the last one");
  RobotState state{now_us, sent->state, {}, std::vector<double>(kShadowJointCount, 0.0)};
  state.position.assign(sent->targets->hand.joints.begin(), sent->targets->hand.joints.end());
  for (size_t j = 0; ticked_ && j < state.position.size(); ++j)
    state.velocity[j] =
        (state.position[j] - last_.position[j]) / (static_cast<double>(now_us - last_.clock_us) * 1e-6);
  ticked_ = true;
  last_ = state;
  return state;
}

}  // namespace glovebench
