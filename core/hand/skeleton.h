#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "core/hand/posture.h"

namespace glovebench {

/// WebXR's 25 joints, then the forearm.
inline constexpr int kJointCount = 26;
inline constexpr int kWristJoint = 0;
inline constexpr int kMiddleMcpJoint = 11;
inline constexpr int kForearmJoint = 25;

/// WebXR names and "forearm".
/// Throws: Error for an unknown name.
const std::string& joint_name(int joint);
int joint_index(const std::string& webxr_name);
/// -1: attached to the palm.
const std::array<int, kJointCount>& joint_parents();
int joint_of_angle(int angle);
/// Thumb to little.
const std::array<int, 5>& fingertip_joints();

using JointPoses = std::array<Eigen::Isometry3d, kJointCount>;

/// The right hand's. A joint's rotation in its parent is R_zero_before * R_y(abduction) * R_x(-flexion) *
/// R_zero_after (zero: core/README.md).
class Skeleton {
 public:
  Skeleton() = default;
  explicit Skeleton(const JointPoses& T_hand_joint_bind);

  JointPoses pose(const Posture& posture) const;
  /// Angles' unit axes, right-handed, hand frame.
  std::array<Eigen::Vector3d, kAngleCount> axes(const JointPoses& T_hand_joint) const;
  const Posture& bind_posture() const { return bind_posture_; }

  /// Position in the parent's frame (else the hand frame), m.
  const Eigen::Vector3d& offset(int joint) const { return joints_.at(joint).offset; }
  void set_offset(int joint, const Eigen::Vector3d& offset) { joints_.at(joint).offset = offset; }

 private:
  struct Joint {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    Eigen::Matrix3d before = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d after = Eigen::Matrix3d::Identity();
    int abduction = -1;
    int flexion = -1;
  };

  std::array<Joint, kJointCount> joints_;
  Posture bind_posture_ = Posture::Zero();
};

}  // namespace glovebench
