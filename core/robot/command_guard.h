#pragma once

#include "core/robot/command_limits.h"

namespace glovebench {

/// The part that a guard controls.
enum class GuardedPart {
  robot,  ///< all joints and `T_base_hand`
  hand,   ///< the hand's joints
  arm,    ///< the wrist (WRJ2) as `T_base_hand`
};

/// Makes commands safe for every sink (core/robot/README.md). Reads no clock. For any input:
/// - Values are finite, rotations valid, joints within limits. J1 and J2 follow ShadowCoupling; motor targets fit
///   the joints. Hand and fingertips are in the workspace (with an arm, to 0.1 mm).
/// - Time stamps rise. Frame stamps go back only after the stream had stopped.
/// - Joints, hand, fingertips and arm keep their speed limits. A step counts as at most `longest_step_s`. One
///   factor slows all.
/// - Nothing moves unless the state is `following`.
/// Safe commands pass bit for bit. Without `start_from` the first targets have no speed limit. With an arm,
/// `T_base_hand` is the pose that its joints reach.
class CommandGuard {
 public:
  /// With `arm`, call `start_from` first.
  /// Throws: Error if the limits have problems, or their workspace is too small for `GuardedPart::arm`.
  explicit CommandGuard(const CommandLimits& limits = {}, GuardedPart part = GuardedPart::robot,
                        std::optional<MountedArm> arm = std::nullopt);

  /// Sets the robot's present targets. J1 and J2 may differ from ShadowCoupling.
  /// Throws: Error unless values are finite and within limits, J1 is not above J2, and an arm's joints are given.
  void start_from(const RobotTargets& measured);

  /// The safe command, at its own time. Empty if time did not advance.
  std::optional<RobotCommand> guard(const RobotCommand& command) { return guard(command, command.timestamp_us); }
  /// The same at `now_us` of a monotonic clock. A stale command is ignored unless the state is `stopped`.
  std::optional<RobotCommand> guard(const RobotCommand& command, int64_t now_us);
  /// The command at `now_us` if none came. Empty if time did not advance.
  std::optional<RobotCommand> tick(int64_t now_us);

  /// The state if no command comes until `now_us`.
  CommandState state_at(int64_t now_us) const;
  /// Interventions since construction.
  const Interventions& interventions() const { return total_; }
  /// With `GuardedPart::arm`, the workspace is kShadowWristReach smaller on all sides.
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
  std::optional<RobotTargets> goal_;
  std::optional<RobotTargets> sent_;
  std::optional<int64_t> now_us_;    ///< of the last output
  std::optional<int64_t> good_us_;   ///< of the last good command
  std::optional<int64_t> stamp_us_;  ///< of the last command
  int64_t frame_us_ = 0;
  TrackStatus status_ = TrackStatus::no_hand;
  bool lost_ = false;
};

}  // namespace glovebench
