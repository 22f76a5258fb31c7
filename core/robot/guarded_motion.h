#pragma once

#include "core/robot/command_guard.h"

namespace glovebench {

/// What stands between two commands: the guard's arithmetic, without its state.

/// Gives each motor the target that follows from its joints'.
void make_actuators(ShadowHandTargets& hand);

/// Why targets cannot be used at all, if so.
std::optional<Intervention> refusal(const RobotTargets& targets);

/// Finite targets moved into the limits; a joint that moved is flagged as clamped. What was done is added to
/// `done`.
RobotTargets within_limits(const RobotTargets& targets, const CommandLimits& limits, Interventions& done);

/// From `from` towards `to`, both within the limits, no farther than the speeds allow in `seconds`. An arm that has
/// no target stays.
RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, Interventions& done);

}  // namespace glovebench
