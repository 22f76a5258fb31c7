#include "core/robot/arm.h"

#include <cmath>

#include "core/base/math.h"

namespace glovebench {
namespace {

// Small against the arm (1.3 m), and few for the way between two frames.
constexpr double kStep = 0.02, kTurn = 0.1;  // m, rad
constexpr double kFarthestPose = 10;         // m: nothing that far away is worth the steps
/// A joint turns no farther in one step: twice the step, divided by the arm's shortest lever (wrist to flange).
constexpr double kFarthestJoint = 0.5;  // rad

bool is_near(const ArmJoints& a, const ArmJoints& b) {
  for (int j = 0; j < kArmJointCount; ++j)
    if (!(std::abs(a[j] - b[j]) <= kFarthestJoint)) return false;
  return true;
}

}  // namespace

const std::array<ArmJointInfo, kArmJointCount>& arm_joint_infos() {
  // The PA-10-7C as commonly given; the speeds are not verified.
  static constexpr std::array<ArmJointInfo, kArmJointCount> infos = {{
      {"S1", -177, 177, 57, 0.315, -90},
      {"S2", -94, 94, 57, 0, 90},
      {"S3", -174, 174, 114, 0.45, -90},
      {"E1", -137, 137, 114, 0, 90},
      {"E2", -255, 255, 360, 0.5, -90},
      {"W1", -165, 165, 360, 0, 90},
      {"W2", -255, 255, 360, 0.08, 0},
  }};
  return infos;
}

Eigen::Isometry3d arm_flange_pose(const ArmJoints& joints) {
  Eigen::Isometry3d T_base_flange = Eigen::Isometry3d::Identity();
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    T_base_flange = T_base_flange * Eigen::AngleAxisd(joints[j], Eigen::Vector3d::UnitZ()) *
                    Eigen::Translation3d(0, 0, info.d_m) *
                    Eigen::AngleAxisd(radians_from_degrees(info.alpha_deg), Eigen::Vector3d::UnitX());
  }
  return T_base_flange;
}

bool ArmFollower::follow(const Eigen::Isometry3d& T_base_flange) {
  const Eigen::Isometry3d from = arm_flange_pose(joints_);
  const Eigen::Vector3d way = T_base_flange.translation() - from.translation();
  if (!T_base_flange.matrix().allFinite() || way.norm() > kFarthestPose) return false;
  const Eigen::Quaterniond q_from(from.linear()), q_to(T_base_flange.linear());
  const double turn = q_from.angularDistance(q_to);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::max(way.norm() / kStep, turn / kTurn))));
  ArmJoints joints = joints_;
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    Eigen::Isometry3d T = Eigen::Translation3d(from.translation() + share * way) * q_from.slerp(share, q_to);
    if (i == steps) T = T_base_flange;
    const std::optional<ArmJoints> next = solver_->solve(T, joints);
    if (!next || !is_near(*next, joints)) return false;
    joints = *next;
  }
  joints_ = joints;
  return true;
}

}  // namespace glovebench
