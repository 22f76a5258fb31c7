#pragma once

#include "core/robot/command_guard.h"

namespace glovebench {

// The guard's computations, without its state.

/// Why the targets are unusable. Empty if they are usable.
std::optional<Intervention> refusal(const RobotTargets& targets);

/// Moves finite targets into the limits: joints, then J1 and J2 by their coupling, then the hand. Flags moved
/// joints. Adds interventions to `done`.
RobotTargets within_limits(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part,
                           Interventions& done);

/// The nearest origin with the hand, and for `robot` the fingertips, in the workspace.
Eigen::Vector3d place_in_workspace(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part);

/// Flags joints and motors that differ from `wanted`. Returns true if any do.
bool flag_changes(ShadowHandTargets& hand, const std::array<double, kShadowJointCount>& wanted);

/// Moves from `from` towards `to`, both within limits, for `seconds`. All parts go the same share of their ways:
/// the largest (to 0.1%) within all speeds. The hand turns about one axis, and shifts where fingertips would leave
/// the workspace. An arm without a target stays. Adds slowed kinds to `done`.
RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, GuardedPart part, Interventions& done);

/// The same with the arm's joints, which `from` has. Limits apply to `carried_pose`, which stays in the workspace.
/// If `to` has no joints, they are solved for the next step; without a solution the arm stays and the fingers go
/// on.
RobotTargets moved_by_arm(const MountedArm& arm, const RobotTargets& from, const RobotTargets& to, double seconds,
                          const CommandLimits& limits, GuardedPart part, Interventions& done);

/// `T_base_hand` for a wrist's pose: the hand's pose, or for `arm` the wrist's.
Eigen::Isometry3d carried_pose(const Eigen::Isometry3d& T_base_wrist,
                               const std::array<double, kShadowJointCount>& joints, GuardedPart part);

}  // namespace glovebench
