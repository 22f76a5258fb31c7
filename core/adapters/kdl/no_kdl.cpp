#include "core/adapters/kdl/make_arm_solver.h"

namespace glovebench {

std::unique_ptr<ArmSolver> make_arm_solver(const ArmJoints&) { return nullptr; }

}  // namespace glovebench
