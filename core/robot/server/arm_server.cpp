#include "core/robot/server/arm_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/robot/server/start_place.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

constexpr double kSlightlyOutside = 5e-5;  // m: less than what is taken as inside at a start (start_place.cpp)

RobotCommand pose_command(const Eigen::Isometry3d& T_base_wrist, int64_t now_us) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = now_us;
  command.status = TrackStatus::tracked;
  command.hold = false;
  command.state = CommandState::following;
  command.targets.emplace().T_base_hand = T_base_wrist;
  return command;
}

ArmJoints arm_joints(const std::vector<double>& start, const std::string& source) {
  if (start.size() != kArmJointCount)
    throw Error(source, "joints", fmt::format("{}", start.size()), fmt::format("{}", kArmJointCount));
  ArmJoints joints;
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    joints[j] = start_angle(start[j], info.min_deg, info.max_deg, source, info.name);
  }
  return joints;
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b));
}

}  // namespace

ArmServer::ArmServer(const CommandLimits& limits, const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist,
                     const std::vector<double>& start, const std::string& source)
    : solver_(solver),
      T_flange_wrist_(T_flange_wrist),
      guard_(limits, GuardedPart::arm),
      limits_(guard_.limits()),
      gate_(limits.stop_after_s),
      joints_(arm_joints(start, source)) {
  RobotTargets standing;
  standing.T_base_hand = wrist_pose(joints_);
  standing.T_base_hand.translation() = start_in_workspace(standing.T_base_hand.translation(), limits_, source);
  guard_.start_from(standing);
}

bool ArmServer::ignores(uint64_t sender, int64_t now_us) {
  const bool foreign = gate_.is_foreign(sender, now_us);
  receipts_[static_cast<size_t>(Receipt::foreign)] += foreign;
  return foreign;
}

Receipt ArmServer::receive(uint64_t sender, const ros::PoseStamped& message, int64_t now_us) {
  if (ignores(sender, now_us)) return Receipt::foreign;
  const PoseRead read = read_pose(message);
  Receipt receipt = read.receipt;
  if (receipt == Receipt::accepted) receipt = gate_.admit(sender, 0, message.stamp, now_us);
  ++receipts_[static_cast<size_t>(receipt)];
  if (receipt == Receipt::accepted) goal_ = read.T_base_wrist;
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

RobotState ArmServer::tick(int64_t now_us) {
  if (ticked_ && now_us <= now_us_) throw std::logic_error("a tick of the arm that is not after the last one");
  std::optional<RobotCommand> sent;
  // The first tick only says what time it is.
  if (ticked_ && goal_) {
    sent = guard_.guard(pose_command(*goal_, now_us), now_us);
    goal_.reset();
  } else {
    sent = guard_.tick(now_us);
  }
  interventions_.add(sent->interventions);
  RobotState state{now_us, sent->state, {}, std::vector<double>(kArmJointCount, 0.0)};
  const double elapsed = ticked_ ? static_cast<double>(now_us - now_us_) * 1e-6 : 0;
  if (ticked_ && sent->state == CommandState::following) {
    const ArmJoints before = joints_;
    joints_ = step_towards(sent->targets->T_base_hand, std::min(elapsed, limits_.longest_step_s));
    for (int j = 0; j < kArmJointCount; ++j) state.velocity[j] = (joints_[j] - before[j]) / elapsed;
  }
  state.position.assign(joints_.begin(), joints_.end());
  ticked_ = true;
  now_us_ = now_us;
  return state;
}

}  // namespace glovebench
