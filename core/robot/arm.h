#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string_view>

namespace glovebench {

/// The arm that carries the hand: a Mitsubishi PA-10-7C.
inline constexpr int kArmJointCount = 7;
/// Joint angles from base to flange, rad.
using ArmJoints = std::array<double, kArmJointCount>;

/// A joint: its limits, its speed, and its Denavit-Hartenberg row, T = R_z(angle) * T_z(d) * R_x(alpha) with a = 0.
struct ArmJointInfo {
  std::string_view name;
  double min_deg;
  double max_deg;
  double max_speed_deg_s;
  double d_m;
  double alpha_deg;
};
const std::array<ArmJointInfo, kArmJointCount>& arm_joint_infos();

/// T_base_flange at those joint angles: x ahead, y left, z up at the base; the flange's z leaves the arm.
Eigen::Isometry3d arm_flange_pose(const ArmJoints& joints);

/// Finds joint angles for a pose of the flange. One by Orocos KDL stands in core/adapters/kdl.
class ArmSolver {
 public:
  virtual ~ArmSolver() = default;
  /// Joint angles within the limits at which the flange has that pose, near `start` (within the limits, too).
  /// Nothing if none were found: the pose is out of reach, or not to be had from there.
  virtual std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const = 0;
};

/// The arm that carries the hand, and how.
struct MountedArm {
  const ArmSolver* solver = nullptr;  ///< outlives whoever has this
  Eigen::Isometry3d T_flange_wrist;   ///< how the hand's forearm is mounted

  /// Where the wrist's first joint (WRJ2) is.
  Eigen::Isometry3d T_base_wrist(const ArmJoints& joints) const { return arm_flange_pose(joints) * T_flange_wrist; }
};

}  // namespace glovebench
