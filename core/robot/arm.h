#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
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

/// The arm's joints at rest, where an ArmFollower starts unless told otherwise: elbow up, the flange 0.6 m ahead of
/// the base, looking down.
inline constexpr ArmJoints kArmAtRest = {0, 0.16, 0, 1.94, 0, 1.04, 1.5708};

/// Follows a pose with the arm without ever changing to joint angles far from the last ones: it solves along the
/// way from the last pose to the next, in steps that are so small that each solution is near the one before.
class ArmFollower {
 public:
  explicit ArmFollower(std::shared_ptr<const ArmSolver> solver, const ArmJoints& start = kArmAtRest)
      : solver_(std::move(solver)), joints_(start) {}

  /// Moves the joints to that pose of the flange. False if it is out of reach: then they stay.
  bool follow(const Eigen::Isometry3d& T_base_flange);
  const ArmJoints& joints() const { return joints_; }

 private:
  std::shared_ptr<const ArmSolver> solver_;
  ArmJoints joints_;
};

}  // namespace glovebench
