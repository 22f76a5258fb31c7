#pragma once

#include "core/robot/command_guard.h"

namespace glovebench {

/// Where targets may be: the guard's arithmetic for one command, without its state.

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

}  // namespace glovebench
