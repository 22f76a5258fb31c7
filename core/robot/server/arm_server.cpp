#include "core/robot/server/arm_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

constexpr int kPoseTopic = 0;
constexpr double kSlightlyOutside = 5e-5;  // m: less than what is taken as inside at a start (start_place.cpp)

/// Without a pose: to hold.
RobotCommand pose_command(const std::optional<Eigen::Isometry3d>& T_base_wrist, int64_t now_us) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = now_us;
  command.status = TrackStatus::tracked;
  command.hold = !T_base_wrist;
  command.state = CommandState::following;
  if (T_base_wrist) command.targets.emplace().T_base_hand = *T_base_wrist;
  return command;
}

ArmJoints arm_joints(const StartPlace& start) {
  if (start.joints.size() != kArmJointCount)
    throw Error(start.source, "joints", fmt::format("{}", start.joints.size()), fmt::format("{}", kArmJointCount));
  ArmJoints joints;
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    joints[j] = start_angle(start.joints[static_cast<size_t>(j)], info.min_deg, info.max_deg, start, info.name);
  }
  return joints;
}

}  // namespace

std::vector<JointMotion> ArmServer::joint_motions(const CommandLimits& limits) {
  std::vector<JointMotion> motions;
  for (const ArmJointInfo& info : arm_joint_infos())
    motions.push_back({radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg),
                       limits.arm_speed_share * radians_from_degrees(info.max_speed_deg_s)});
  return motions;
}

ArmServer::ArmServer(const CommandLimits& limits, const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist,
                     const StartPlace& start)
    : solver_(solver),
      T_flange_wrist_(T_flange_wrist),
      guard_(limits, GuardedPart::arm),
      limits_(guard_.limits()),
      stream_(limits, kPoseTopic + 1),
      joints_(arm_joints(start)) {
  RobotTargets standing;
  standing.T_base_hand = wrist_pose(joints_);
  standing.T_base_hand.translation() =
      start_in_workspace(standing.T_base_hand.translation(), limits_, start.source);
  guard_.start_from(standing);
}

Receipt ArmServer::receive(const ros::PoseStamped& message, const Arrival& arrival) {
  if (stream_.ignores(arrival.sender, arrival.now_us)) return Receipt::foreign;
  const PoseRead read = read_pose(message);
  const Receipt receipt = stream_.receive(arrival, kPoseTopic, message.stamp, read.receipt);
  if (receipt != Receipt::accepted) return receipt;
  goal_ = read.T_base_wrist;
  changed_ = true;
  return receipt;
}

/// How far the wrist is outside its workspace, m.
double ArmServer::outside(const ArmJoints& joints) const {
  const Eigen::Vector3d p = wrist_pose(joints).translation();
  return (p.cwiseMax(limits_.workspace_min).cwiseMin(limits_.workspace_max) - p).norm();
}

/// Joints nearer to those of a pose, no farther away than all speeds allow in that time, with the wrist in the
/// workspace.
ArmJoints ArmServer::step_towards(const Eigen::Isometry3d& T_base_wrist, double seconds) {
  const double farthest_outside = std::max(kSlightlyOutside, outside(joints_));
  const auto step = [&](const Eigen::Isometry3d& T) -> std::optional<ArmJoints> {
    const std::optional<ArmJoints> wanted = solver_.solve(T * T_flange_wrist_.inverse(), joints_);
    if (!wanted) return std::nullopt;
    return next_joints(*wanted, seconds);
  };
  std::optional<ArmJoints> next = step(T_base_wrist);
  if (!next) interventions_.add(Intervention::arm_unreachable);
  if (!next || outside(*next) <= farthest_outside) return next.value_or(joints_);
  // Joints that have to catch up would take the wrist out on a curve; the straight way stays inside.
  interventions_.add(Intervention::workspace);
  const Eigen::Isometry3d T_base_now = wrist_pose(joints_);
  const Eigen::Quaterniond q_now(T_base_now.linear()), q_to(T_base_wrist.linear());
  const Eigen::Vector3d way = T_base_wrist.translation() - T_base_now.translation();
  const double turn = q_now.angularDistance(q_to);
  double share = std::min({1.0, limits_.hand_speed * seconds / way.norm(), limits_.hand_turn_speed * seconds / turn,
                           limits_.fingertip_speed * seconds / (way.norm() + kShadowWristReach * turn)});
  for (int attempt = 0; attempt < 4; ++attempt, share /= 2) {
    next =
        step(Eigen::Translation3d(T_base_now.translation() + share * way) * q_now.slerp(share, q_to).normalized());
    if (next && outside(*next) <= farthest_outside) return *next;
  }
  return joints_;
}

/// On the way of all joints to those that are wanted, as far as all speeds allow.
ArmJoints ArmServer::next_joints(const ArmJoints& wanted, double seconds) {
  double share = 1;  // of the way in joint space: the wrist then moves about as much less
  for (int j = 0; j < kArmJointCount; ++j) {
    const double speed = limits_.arm_speed_share * radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s);
    const double way = std::abs(wanted[j] - joints_[j]);
    if (way > speed * seconds) share = std::min(share, speed * seconds / way);
  }
  if (share < 1) interventions_.add(Intervention::arm_speed);
  const Eigen::Isometry3d T_base_now = wrist_pose(joints_);
  for (int attempt = 0; attempt < 8; ++attempt) {
    ArmJoints next;
    for (int j = 0; j < kArmJointCount; ++j) next[j] = joints_[j] + share * (wanted[j] - joints_[j]);
    const Eigen::Isometry3d T_base_next = wrist_pose(next);
    const double way = (T_base_next.translation() - T_base_now.translation()).norm();
    const double turn = angle_between(T_base_now.linear(), T_base_next.linear());
    using Excess = std::pair<double, Intervention>;
    const auto [excess, kind] =
        std::max({Excess(way / (limits_.hand_speed * seconds), Intervention::hand_speed),
                  Excess(turn / (limits_.hand_turn_speed * seconds), Intervention::hand_turn_speed),
                  Excess((way + kShadowWristReach * turn) / (limits_.fingertip_speed * seconds),
                         Intervention::fingertip_speed)});
    if (excess <= 1 + 1e-9) return next;
    if (attempt == 0) interventions_.add(kind);
    share *= 0.99 / excess;
  }
  return joints_;
}

RobotState ArmServer::tick(const ServerTime& now, bool may_move) {
  if (ticked_ && now.clock_us <= now_us_)
    throw std::logic_error("a tick of the arm that is not after the last one");
  stream_.tick(now.clock_us, now.system_us);
  if (!stream_.is_current(now.clock_us)) goal_.reset();
  const bool follows = may_move && ticked_ && goal_;  // the first tick only says what time it is
  std::optional<RobotCommand> sent;
  if (!follows || changed_) {
    sent = guard_.guard(pose_command(follows ? goal_ : std::nullopt, now.clock_us), now.clock_us);
    changed_ = !follows;
  } else {
    sent = guard_.tick(now.clock_us);
  }
  interventions_.add(sent->interventions);
  RobotState state{now.clock_us, sent->state, {}, std::vector<double>(kArmJointCount, 0.0)};
  const double elapsed = ticked_ ? static_cast<double>(now.clock_us - now_us_) * 1e-6 : 0;
  if (ticked_ && sent->state == CommandState::following) {
    const ArmJoints before = joints_;
    joints_ = step_towards(sent->targets->T_base_hand, std::min(elapsed, limits_.longest_step_s));
    for (int j = 0; j < kArmJointCount; ++j) state.velocity[j] = (joints_[j] - before[j]) / elapsed;
  }
  state.position.assign(joints_.begin(), joints_.end());
  ticked_ = true;
  now_us_ = now.clock_us;
  return state;
}

}  // namespace glovebench
