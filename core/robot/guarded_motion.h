#pragma once

#include "core/robot/command_guard.h"

namespace glovebench {

// The guard's arithmetic for one command, without its state: where targets may be, and how far they may move.

/// Why targets cannot be used at all, if so.
std::optional<Intervention> refusal(const RobotTargets& targets);

/// Finite targets moved into the limits: joints, then J1 and J2 as their motor moves them, then the place of the
/// hand. A joint that moved is flagged as clamped. What was done is added to `done`.
RobotTargets within_limits(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part,
                           Interventions& done);

/// The place nearest to where the hand is at which its origin is in the workspace, and all fingertips are if `part`
/// is the robot.
Eigen::Vector3d place_in_workspace(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part);

/// Flags the joints that are not what was wanted of them, and the motors whose targets are not. Whether there are
/// any.
bool flag_changes(ShadowHandTargets& hand, const std::array<double, kShadowJointCount>& wanted);

/// From `from` towards `to`, both within the limits, no farther than the speeds allow in `seconds`. Hand, fingers
/// and arm go the same share of their ways, the largest (to 0.1%) at which nothing is too fast: the motor of each
/// joint and the hand's origin go straight, the hand turns about one axis. On the way the hand is moved aside where
/// its fingertips would leave the workspace. An arm that has no target stays. What was too fast is added to `done`.
RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, GuardedPart part, Interventions& done);

/// The same of a hand that an arm carries: what is limited is where the joints take it, `carried_pose`. `from` has
/// the arm's joints. If `to` has them, all joints go straight to theirs. If not, the arm's are those of the next
/// step of the pose; where there are none, the arm stays and the fingers go on. A share of the way that would take
/// hand or fingertips out of the workspace is too large, too.
RobotTargets moved_by_arm(const MountedArm& arm, const RobotTargets& from, const RobotTargets& to, double seconds,
                          const CommandLimits& limits, GuardedPart part, Interventions& done);

/// What a guard calls `T_base_hand` where the arm's wrist is there: the hand's pose, or of an arm alone the
/// wrist's.
Eigen::Isometry3d carried_pose(const Eigen::Isometry3d& T_base_wrist,
                               const std::array<double, kShadowJointCount>& joints, GuardedPart part);

}  // namespace glovebench
