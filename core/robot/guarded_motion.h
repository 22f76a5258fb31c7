#pragma once

#include "core/robot/command_guard.h"

namespace glovebench {

/// From `from` towards `to`, both within the limits, no farther than the speeds allow in `seconds`. Hand, fingers
/// and arm go the same share of their ways, the largest (to 0.1%) at which nothing is too fast: the motor of each
/// joint and the hand's origin go straight, the hand turns about one axis. On the way the hand is moved aside where
/// its fingertips would leave the workspace. An arm that has no target stays. What was too fast is added to `done`.
RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, GuardedPart part, Interventions& done);

}  // namespace glovebench
