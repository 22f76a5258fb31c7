#pragma once

#include <memory>

#include "core/robot/arm.h"

namespace glovebench {

/// Inverse kinematics of the PA-10-7C by Orocos KDL: Newton-Raphson within the joint limits
/// (ChainIkSolverPos_NR_JL) from `start`, or a little nearer to `rest` than that in what the pose leaves open. A
/// solution is one whose flange is within 0.01 mm and 0.00001 rad of the pose by the core's own kinematics. One
/// thread at a time. Empty in a build without Orocos KDL.
std::unique_ptr<ArmSolver> make_arm_solver(const ArmJoints& rest = kArmAtRest);

}  // namespace glovebench
