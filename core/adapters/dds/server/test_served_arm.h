#pragma once

// For tests of a server that moves the arm.
#include <algorithm>
#include <optional>
#include <vector>

#include "core/robot/test_arm_solver.h"

namespace glovebench {

inline constexpr int64_t kArmPeriodUs = 10'000;
inline constexpr uint64_t kSender = 3;
inline constexpr double kArmRounding = 1e-9;  // of a pose after seven rotations

/// T_base_wrist for the arm's joints, the last ones.
inline Eigen::Isometry3d wrist_of(const std::vector<double>& positions, const Eigen::Isometry3d& T_flange_wrist) {
  ArmJoints joints;
  std::copy_n(positions.end() - kArmJointCount, kArmJointCount, joints.begin());
  return arm_flange_pose(joints) * T_flange_wrist;
}

/// Finds nothing while `asleep`.
class SleepingSolver : public JacobianSolver {
 public:
  std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const override {
    return asleep ? std::nullopt : JacobianSolver::solve(T_base_flange, start);
  }
  bool asleep = true;
};

}  // namespace glovebench
