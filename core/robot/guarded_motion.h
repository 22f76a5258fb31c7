#pragma once

#include "core/robot/command_guard.h"

namespace glovebench {

// The guard's computations, without its state.

/// Why the targets are unusable, if they are.
std::optional<Intervention> refusal(const RobotTargets& targets);

/// Moves finite targets into the limits: joints, then J1 and J2 by the coupling, then the hand. Flags moved joints.
/// Adds interventions to `done`.
RobotTargets within_limits(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part,
                           Interventions& done);

/// The nearest hand origin that is in the workspace, for `robot` with all fingertips.
Eigen::Vector3d place_in_workspace(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part);

/// Flags joints and motors that differ from `wanted`. Returns whether any do.
bool flag_changes(ShadowHandTargets& hand, const std::array<double, kShadowJointCount>& wanted);

/// Moves from `from` towards `to`, both within limits, for `seconds`. All parts go the same share of their ways:
/// the largest (to 0.1%) that keeps all speeds. The hand turns about one axis. It shifts where fingertips would
/// leave the workspace. An arm without a target stays. Adds the limited speeds to `done`.
RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, GuardedPart part, Interventions& done);

/// The same by the arm's joints, which `from` must have. Limits apply to `carried_pose`. If `to` has no arm joints,
/// solves for the next step's. Without a solution the arm stays and the fingers go on.
RobotTargets moved_by_arm(const MountedArm& arm, const RobotTargets& from, const RobotTargets& to, double seconds,
                          const CommandLimits& limits, GuardedPart part, Interventions& done);

/// `T_base_hand` that a guard limits: the hand's pose, or for `arm` the wrist's.
Eigen::Isometry3d carried_pose(const Eigen::Isometry3d& T_base_wrist,
                               const std::array<double, kShadowJointCount>& joints, GuardedPart part);

}  // namespace glovebench
