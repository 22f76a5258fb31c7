#include "core/robot/arm.h"

#include "core/base/angles.h"

namespace glovebench {

const std::array<ArmJointInfo, kArmJointCount>& arm_joint_infos() {
  // Of the PA-10-7C as it is commonly given; the speeds are not verified.
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

}  // namespace glovebench
