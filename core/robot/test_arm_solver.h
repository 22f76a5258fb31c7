#pragma once

#include <Eigen/Dense>

#include "core/base/math.h"
#include "core/robot/arm.h"

namespace glovebench {

class JacobianSolver : public ArmSolver {
 public:
  std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const override {
    Eigen::Matrix<double, kArmJointCount, 1> q = Eigen::Map<const Eigen::Matrix<double, 7, 1>>(start.data());
    for (int i = 0; i < 100; ++i) {
      const Eigen::Matrix<double, 6, 1> wanted = difference(pose(q), T_base_flange);
      if (wanted.norm() < 1e-10) return within_limits(joints(q));
      Eigen::Matrix<double, 6, kArmJointCount> J;
      for (int j = 0; j < kArmJointCount; ++j) {
        auto moved = q;
        moved[j] += 1e-6;
        J.col(j) = difference(pose(q), pose(moved)) * 1e6;
      }
      const Eigen::Matrix<double, 6, 6> damped = J * J.transpose() + 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
      q += J.transpose() * damped.ldlt().solve(wanted);
    }
    return std::nullopt;
  }

 private:
  static std::optional<ArmJoints> within_limits(const ArmJoints& joints) {
    for (int j = 0; j < kArmJointCount; ++j) {
      const ArmJointInfo& info = arm_joint_infos()[j];
      if (!(joints[j] >= radians_from_degrees(info.min_deg) && joints[j] <= radians_from_degrees(info.max_deg)))
        return std::nullopt;
    }
    return joints;
  }
  static ArmJoints joints(const Eigen::Matrix<double, 7, 1>& q) {
    ArmJoints result;
    for (int j = 0; j < kArmJointCount; ++j) result[j] = q[j];
    return result;
  }
  static Eigen::Isometry3d pose(const Eigen::Matrix<double, 7, 1>& q) { return arm_flange_pose(joints(q)); }
  static Eigen::Matrix<double, 6, 1> difference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
    Eigen::Matrix<double, 6, 1> result;
    result << to.translation() - from.translation(), turn.angle() * turn.axis();
    return result;
  }
};

}  // namespace glovebench
