#pragma once

#include <string>
#include <vector>

#include "core/robot/robot_command.h"

namespace glovebench {

/// What a stream of commands may do. Where the joints lie is in `shadow_joint_infos` and `arm_joint_infos`.
struct CommandLimits {
  double hand_joint_speed = 2;   ///< of each joint of the hand, rad/s: a choice, within what Shadow's hands can do
  double hand_speed = 0.25;      ///< of the hand's origin, m/s: the number of ISO 10218-1's reduced speed
  double hand_turn_speed = 1.5;  ///< of its turning, rad/s
  double arm_speed_share = 1;    ///< of the speeds in `arm_joint_infos`, 0..1
  Eigen::Vector3d workspace_min{-1.5, -1.5, 0};  ///< where the hand may be in the arm's base frame, m
  Eigen::Vector3d workspace_max{1.5, 1.5, 2};
  double longest_step_s =
      0.1;                  ///< however long ago the last command was sent, nothing moves farther than in this time
  double silence_s = 0.15;  ///< without a command for longer than this: as if the hand was lost
  double stop_after_s = 0.5;  ///< lost or silent for longer than this: stopped. At least silence_s

  /// All that is wrong, one entry each; empty if nothing is.
  std::vector<std::string> problems() const;
};

/// Stands in front of every sink and changes what is not safe. What it returns holds, whatever it is given:
/// - all values are finite, joints of hand and arm within their limits, J1 not above J2, each motor's target that
///   of its joints, rotations are rotations, the hand is in the workspace;
/// - time stamps rise; frame stamps do not go back, unless the stream had stopped;
/// - from one command to the next, joints, hand and arm move no farther than their speeds allow in the time between
///   the two stamps, or in `longest_step_s` if that is shorter: so also after a stop;
/// - while the state is not `following`, nothing moves.
/// What already is like that passes unchanged, bit for bit.
///
/// There is no clock in here: time is what `now_us` says, of one monotonic clock of the caller, or the commands'
/// own time stamps. A command is `hold` or lost, or one that is refused: the last targets are sent again, as
/// `holding`, and after `stop_after_s` as `stopped`. Another good command makes it follow again, from where it
/// stands. The first targets pass at whatever place they are, since where the robot stands is not known, unless
/// `start_from` has said it. The joints move each by itself, and hand and arm do: slowed down, they are not on the
/// path any more.
class CommandGuard {
 public:
  /// Throws Error if the limits have problems.
  explicit CommandGuard(const CommandLimits& limits = {});

  /// Where the robot stands: the first command starts from there. Throws Error unless it is finite and within the
  /// limits.
  void start_from(const RobotTargets& measured);

  /// What may be sent for a command; its own stamp is the time. Nothing if time did not go on.
  std::optional<RobotCommand> guard(const RobotCommand& command) { return guard(command, command.timestamp_us); }
  /// The same for a command that arrived at `now_us`; what is sent has this time stamp. A stamp of the sender that
  /// goes back is refused until the stream has stopped: then the sender may have started anew.
  std::optional<RobotCommand> guard(const RobotCommand& command, int64_t now_us);
  /// What may be sent at `now_us` when no command came: on the way to the last target, or held, or stopped. Nothing
  /// if time did not go on.
  std::optional<RobotCommand> tick(int64_t now_us);

  /// Of all that was given so far. Those of a command that is sent are in it, with those since the last one.
  const Interventions& interventions() const { return total_; }
  const CommandLimits& limits() const { return limits_; }

 private:
  void note(Intervention kind);
  bool is_stale(const RobotCommand& command) const;
  void take(const RobotCommand& command, int64_t now_us);
  /// The state at a time if nothing arrives until then.
  CommandState state_at(int64_t now_us) const;
  void become(CommandState state);
  RobotCommand send(int64_t now_us);

  CommandLimits limits_;
  Interventions total_, pending_;
  CommandState state_ = CommandState::stopped;
  std::optional<RobotTargets> goal_;  ///< of the last good command, within the limits
  std::optional<RobotTargets> sent_;
  std::optional<int64_t> now_us_;    ///< of what was sent last
  std::optional<int64_t> good_us_;   ///< when the last good command came
  std::optional<int64_t> stamp_us_;  ///< of the last command, by its sender
  int64_t frame_us_ = 0;             ///< and of its frame
  TrackStatus status_ = TrackStatus::no_hand;
  bool lost_ = false;  ///< the last command was not a good one
};

}  // namespace glovebench
