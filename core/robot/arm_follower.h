#pragma once

#include <memory>

#include "core/robot/arm.h"

namespace glovebench {

/// The arm's joints at rest, where an ArmFollower starts unless told otherwise: elbow up, the flange 0.6 m ahead of
/// the base, looking down.
inline constexpr ArmJoints kArmAtRest = {0, 0.16, 0, 1.94, 0, 1.04, 1.5708};

/// Follows a pose with the arm without ever changing to joint angles far from the last ones: it solves along the
/// way from the last pose to the next, in steps that are so small that each solution is near the one before.
class ArmFollower {
 public:
  explicit ArmFollower(std::shared_ptr<const ArmSolver> solver, const ArmJoints& start = kArmAtRest)
      : solver_(std::move(solver)), joints_(start) {}

  /// Whether the flange reaches that pose; if not, `joints` stay what they were.
  bool follow(const Eigen::Isometry3d& T_base_flange);
  const ArmJoints& joints() const { return joints_; }

 private:
  std::shared_ptr<const ArmSolver> solver_;
  ArmJoints joints_;
};

}  // namespace glovebench
