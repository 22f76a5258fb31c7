#pragma once

#include <memory>

#include "core/robot/arm.h"

namespace glovebench {

/// Inverse kinematics by Orocos KDL (ChainIkSolverPos_NR_JL), from `start` a little towards `rest`. Exact to 0.01
/// mm and 1e-5 rad. Not thread-safe. Null without KDL.
std::unique_ptr<ArmSolver> make_arm_solver(const ArmJoints& rest = kArmAtRest);

}  // namespace glovebench
