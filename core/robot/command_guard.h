#pragma once

#include "core/robot/command_limits.h"

namespace glovebench {

/// What a guard knows of the robot, and so which fingertips it can look after.
enum class GuardedPart {
  robot,  ///< `T_base_hand` and all joints: fingertips in the base frame
  hand,   ///< the joints of hand and wrist alone: the speed of fingertips in the forearm's frame; `T_base_hand`
          ///< stays
  arm,    ///< the wrist (WRJ2) alone, as `T_base_hand`: fingertips may be anywhere within kShadowWristReach of it
};

/// Stands in front of every sink and changes what is not safe. What it returns holds, whatever it is given:
/// - all values are finite, joints of hand and arm within their limits, J1 and J2 of a finger as its motor
///   moves them (ShadowCoupling), each motor's target that of its joints, rotations are rotations, the hand's
///   origin and its fingertips are in the workspace, with an arm to 0.1 mm;
/// - time stamps rise; frame stamps do not go back, unless the stream had stopped;
/// - from one command to the next, joints, hand, fingertips and arm move no farther than their speeds allow in the
///   time between the two stamps, or in `longest_step_s` if that is shorter: so also after a stop. What would be
///   too fast is slowed down as a whole: hand, fingers and arm go the same share of their ways;
/// - while the state is not `following`, nothing moves.
/// What already is like that passes unchanged, bit for bit.
///
/// A guard that has the arm moves its joints, too: it sends those, and `T_base_hand` is where they take the hand
/// (guarded_motion.h). Commands for it have a pose to go to, or the arm's joints. What the solver does not reach
/// counts as `arm_unreachable`.
///
/// There is no clock in here: time is what `now_us` says, of one monotonic clock of the caller, or the commands'
/// own time stamps. A command is `hold` or lost, or one that is refused: the last targets are sent again, as
/// `holding`, and after `stop_after_s` as `stopped`. Another good command makes it follow again, from where it
/// stands. The first targets pass at whatever place they are, since where the robot stands is not known, unless
/// `start_from` has said it.
class CommandGuard {
 public:
  /// Throws Error if the limits have problems, or leave an arm no place within the reach of its fingertips. With
  /// `arm`, `start_from` must come first.
  explicit CommandGuard(const CommandLimits& limits = {}, GuardedPart part = GuardedPart::robot,
                        std::optional<MountedArm> arm = std::nullopt);

  /// Where the robot stands: the first command starts from there. Throws Error unless it is finite and within the
  /// limits, with the joints of an arm that the guard has. J1 and J2 may be off their model, as of a finger that
  /// touches something, but J1 not above J2: they come to obey it while the finger moves.
  void start_from(const RobotTargets& measured);

  /// What may be sent for a command; its own stamp is the time. Nothing if time did not go on.
  std::optional<RobotCommand> guard(const RobotCommand& command) { return guard(command, command.timestamp_us); }
  /// The same for a command that arrived at `now_us`; what is sent has this time stamp. A stamp of the sender that
  /// goes back is refused until the stream has stopped: then the sender may have started anew.
  std::optional<RobotCommand> guard(const RobotCommand& command, int64_t now_us);
  /// What may be sent at `now_us` when no command came: on the way to the last target, or held, or stopped. Nothing
  /// if time did not go on.
  std::optional<RobotCommand> tick(int64_t now_us);

  /// The state at a time if nothing arrives until then.
  CommandState state_at(int64_t now_us) const;
  /// Of all that was given so far. Those of a command that is sent are in it, with those since the last one.
  const Interventions& interventions() const { return total_; }
  /// Those of the guarded part: an arm's workspace is that of the wrist, smaller by kShadowWristReach on all sides.
  const CommandLimits& limits() const { return limits_; }

 private:
  void note(Intervention kind);
  bool is_stale(const RobotCommand& command) const;
  void take(const RobotCommand& command, int64_t now_us);
  void become(CommandState state);
  RobotCommand send(int64_t now_us);

  CommandLimits limits_;
  GuardedPart part_;
  std::optional<MountedArm> arm_;
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
