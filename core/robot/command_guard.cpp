#include "core/robot/command_guard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "core/base/error.h"
#include "core/robot/guarded_motion.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

/// For any two times; 0 if `now` is not after `then`.
double seconds_between(int64_t then_us, int64_t now_us) {
  if (now_us <= then_us) return 0;
  return static_cast<double>(static_cast<uint64_t>(now_us) - static_cast<uint64_t>(then_us)) * 1e-6;
}

bool is_lost(const RobotCommand& command) {
  return command.hold || !command.targets || command.status != TrackStatus::tracked ||
         command.state != CommandState::following;
}

/// Shrinks the workspace to where a wrist keeps all fingertips inside.
void shrink_workspace(CommandLimits& limits) {
  limits.workspace_min.array() += kShadowWristReach;
  limits.workspace_max.array() -= kShadowWristReach;
  if ((limits.workspace_min.array() <= limits.workspace_max.array()).all()) return;
  throw Error(
      fmt::format("command limits: a side of the workspace is shorter than {} m, twice the reach of fingertips "
                  "about the wrist",
                  2 * kShadowWristReach));
}

/// Why targets cannot be a start.
std::vector<std::string_view> problems_of_start(Interventions needed) {
  std::vector<std::string_view> problems;
  for (const Intervention kind : all_values<Intervention>())
    if (kind != Intervention::coupling && needed[kind] > 0) problems.push_back(to_string(kind));
  return problems;
}

}  // namespace

CommandGuard::CommandGuard(const CommandLimits& limits, GuardedPart part, std::optional<MountedArm> arm)
    : limits_(limits), part_(part), arm_(std::move(arm)) {
  const std::vector<std::string> problems = limits.problems();
  if (!problems.empty()) throw Error(fmt::format("command limits: {}", fmt::join(problems, "; ")));
  if (part == GuardedPart::arm) shrink_workspace(limits_);
}

void CommandGuard::start_from(const RobotTargets& measured) {
  Interventions needed;
  if (const std::optional<Intervention> reason = refusal(measured))
    throw Error("robot", "measured state", std::string(to_string(*reason)), "finite values and a rotation");
  within_limits(measured, limits_, part_, needed);
  if (const std::vector<std::string_view> problems = problems_of_start(needed); !problems.empty())
    throw Error("robot", "measured state", fmt::format("outside the limits ({})", fmt::join(problems, ", ")),
                "joints within theirs, hand and fingertips in the workspace");
  sent_ = measured;
  if (!arm_) return;
  if (!measured.arm) throw Error("robot", "measured state", "no joints of the arm", "all of them");
  sent_->T_base_hand = carried_pose(arm_->T_base_wrist(*measured.arm), measured.hand.joints, part_);
}

void CommandGuard::note(Intervention kind) {
  pending_.add(kind);
  total_.add(kind);
}

bool CommandGuard::is_stale(const RobotCommand& command) const {
  return stamp_us_ && (command.timestamp_us <= *stamp_us_ || command.frame_timestamp_us < frame_us_);
}

CommandState CommandGuard::state_at(int64_t now_us) const {
  if (!good_us_) return CommandState::stopped;
  const double silence = seconds_between(*good_us_, now_us);
  if (silence > limits_.stop_after_s) return CommandState::stopped;
  return lost_ || silence > limits_.silence_s ? CommandState::holding : CommandState::following;
}

void CommandGuard::become(CommandState state) {
  if (state == CommandState::stopped && state_ != state) note(Intervention::stop);
  state_ = state;
}

void CommandGuard::take(const RobotCommand& command, int64_t now_us) {
  stamp_us_ = command.timestamp_us;
  frame_us_ = command.frame_timestamp_us;
  status_ = command.status;
  pending_.add(command.interventions);
  total_.add(command.interventions);
  lost_ = true;
  if (is_lost(command)) return;
  if (const std::optional<Intervention> reason = refusal(*command.targets)) return note(*reason);
  Interventions done;
  goal_ = within_limits(*command.targets, limits_, part_, done);
  pending_.add(done);
  total_.add(done);
  good_us_ = now_us;
  lost_ = false;
}

std::optional<RobotCommand> CommandGuard::guard(const RobotCommand& command, int64_t now_us) {
  if (now_us_ && now_us <= *now_us_) {
    note(Intervention::stale);
    return std::nullopt;
  }
  become(state_at(now_us));
  if (is_stale(command) && state_ != CommandState::stopped)
    note(Intervention::stale);
  else
    take(command, now_us);
  return send(now_us);
}

std::optional<RobotCommand> CommandGuard::tick(int64_t now_us) {
  if (now_us_ && now_us <= *now_us_) return std::nullopt;
  return send(now_us);
}

RobotCommand CommandGuard::send(int64_t now_us) {
  become(state_at(now_us));
  if (state_ != CommandState::following && sent_) note(Intervention::hold);
  if (state_ == CommandState::following) {
    const double seconds =
        now_us_ ? std::min(seconds_between(*now_us_, now_us), limits_.longest_step_s) : limits_.longest_step_s;
    Interventions done;
    if (arm_)
      sent_ = moved_by_arm(*arm_, sent_.value(), *goal_, seconds, limits_, part_, done);
    else
      sent_ = sent_ ? moved_towards(*sent_, *goal_, seconds, limits_, part_, done) : *goal_;
    pending_.add(done);
    total_.add(done);
  }
  RobotCommand command;
  command.frame_timestamp_us = frame_us_;
  command.timestamp_us = now_us;
  command.status = status_;
  command.hold = state_ != CommandState::following;
  command.state = state_;
  command.targets = sent_;
  command.interventions = std::exchange(pending_, {});
  now_us_ = now_us;
  return command;
}

}  // namespace glovebench
