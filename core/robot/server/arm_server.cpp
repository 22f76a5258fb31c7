#include "core/robot/server/arm_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/angles.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

RobotCommand pose_command(const Eigen::Isometry3d& T_base_wrist, int64_t now_us) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = now_us;
  command.status = TrackStatus::tracked;
  command.hold = false;
  command.state = CommandState::following;
  command.targets.emplace().T_base_hand = T_base_wrist;
  return command;
}

ArmJoints arm_joints(const std::vector<double>& start) {
  if (start.size() != kArmJointCount)
    throw Error("arm server", "joints", fmt::format("{}", start.size()), fmt::format("{}", kArmJointCount));
  ArmJoints joints;
  std::ranges::copy(start, joints.begin());
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    const double angle_deg = degrees_from_radians(joints[j]);
    if (!(angle_deg >= info.min_deg && angle_deg <= info.max_deg))
      throw Error("arm server", std::string(info.name), fmt::format("{} degrees", angle_deg),
                  fmt::format("{} to {}", info.min_deg, info.max_deg));
  }
  return joints;
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b));
}

}  // namespace

ArmServer::ArmServer(const CommandLimits& limits, const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist,
                     const std::vector<double>& start)
    : limits_(limits),
      solver_(solver),
      T_flange_wrist_(T_flange_wrist),
      guard_(limits),
      gate_(limits.stop_after_s),
      joints_(arm_joints(start)) {
  RobotTargets standing;
  standing.T_base_hand = wrist_pose(joints_);
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

/// Joints nearer to those of a pose, no farther away than all speeds allow in that time.
ArmJoints ArmServer::step_towards(const Eigen::Isometry3d& T_base_wrist, double seconds) {
  const std::optional<ArmJoints> wanted = solver_.solve(T_base_wrist * T_flange_wrist_.inverse(), joints_);
  if (!wanted) {
    interventions_.add(Intervention::arm_unreachable);
    return joints_;
  }
  double share = 1;  // of the way in joint space: the wrist then moves about as much less
  for (int j = 0; j < kArmJointCount; ++j) {
    const double speed = limits_.arm_speed_share * radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s);
    const double way = std::abs((*wanted)[j] - joints_[j]);
    if (way > speed * seconds) share = std::min(share, speed * seconds / way);
  }
  if (share < 1) interventions_.add(Intervention::arm_speed);
  const Eigen::Isometry3d T_base_now = wrist_pose(joints_);
  for (int attempt = 0; attempt < 8; ++attempt) {
    ArmJoints next;
    for (int j = 0; j < kArmJointCount; ++j) next[j] = joints_[j] + share * ((*wanted)[j] - joints_[j]);
    const Eigen::Isometry3d T_base_next = wrist_pose(next);
    const double way =
        (T_base_next.translation() - T_base_now.translation()).norm() / (limits_.hand_speed * seconds);
    const double turn =
        angle_between(T_base_now.linear(), T_base_next.linear()) / (limits_.hand_turn_speed * seconds);
    const double excess = std::max(way, turn);
    if (excess <= 1 + 1e-9) return next;
    if (attempt == 0) interventions_.add(way > turn ? Intervention::hand_speed : Intervention::hand_turn_speed);
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
