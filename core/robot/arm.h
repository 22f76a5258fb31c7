#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace glovebench {

/// Mitsubishi PA-10-7C.
inline constexpr int kArmJointCount = 7;
/// Joint angles from base to flange, rad.
using ArmJoints = std::array<double, kArmJointCount>;

/// Denavit-Hartenberg row: T = R_z(angle) * T_z(d) * R_x(alpha).
struct ArmJointInfo {
  std::string_view name;
  double min_deg;
  double max_deg;
  double max_speed_deg_s;
  double d_m;
  double alpha_deg;
};
const std::array<ArmJointInfo, kArmJointCount>& arm_joint_infos();

/// T_base_flange; z points away from the arm.
Eigen::Isometry3d arm_flange_pose(const ArmJoints& joints);

/// Inverse kinematics (core/adapters/kdl).
class ArmSolver {
 public:
  virtual ~ArmSolver() = default;
  /// Within limits, near `start`. Empty if none is found.
  virtual std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const = 0;
};

struct MountedArm {
  const ArmSolver* solver = nullptr;  ///< must outlive this
  Eigen::Isometry3d T_flange_wrist;   ///< mount of the forearm

  Eigen::Isometry3d T_base_wrist(const ArmJoints& joints) const { return arm_flange_pose(joints) * T_flange_wrist; }
};

/// Elbow up, flange 0.6 m ahead of the base, looking down.
inline constexpr ArmJoints kArmAtRest = {0, 0.16, 0, 1.94, 0, 1.04, 1.5708};

/// Solves in small steps, so joint angles never jump.
class ArmFollower {
 public:
  explicit ArmFollower(std::shared_ptr<const ArmSolver> solver, const ArmJoints& start = kArmAtRest)
      : solver_(std::move(solver)), joints_(start) {}

  /// False, and stays, if the pose is out of reach.
  bool follow(const Eigen::Isometry3d& T_base_flange);
  const ArmJoints& joints() const { return joints_; }

 private:
  std::shared_ptr<const ArmSolver> solver_;
  ArmJoints joints_;
};

}  // namespace glovebench
