#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "core/hand/posture.h"

namespace glovebench {

/// The 25 joints of the WebXR hand and, last, the forearm.
inline constexpr int kJointCount = 26;
inline constexpr int kWristJoint = 0;
inline constexpr int kForearmJoint = 25;

/// WebXR name of a joint ("thumb-tip"; the last is "forearm"), and back. `joint_index` throws Error if there is no
/// such joint.
const std::string& joint_name(int joint);
int joint_index(const std::string& webxr_name);
/// Parent of each joint; -1 for what is fixed to the palm (wrist, finger metacarpals) or hangs on it.
const std::array<int, kJointCount>& joint_parents();
/// The joint that an angle turns.
int joint_of_angle(int angle);
/// The fingertip joints, thumb to little.
const std::array<int, 5>& fingertip_joints();

using JointPoses = std::array<Eigen::Isometry3d, kJointCount>;

/// The kinematic tree of the hand. A moving joint's rotation in its parent is
/// R_zero_before * R_y(abduction) * R_x(-flexion) * R_zero_after: abduction first, then flexion about the abducted
/// axis. At zero the finger joints line up with the hand frame's -z; the thumb's base keeps its bind orientation.
class Skeleton {
 public:
  Skeleton() = default;
  /// From the bind pose in the hand frame (right hand).
  explicit Skeleton(const JointPoses& T_hand_joint_bind);

  /// Pose of every joint in the hand frame (right hand).
  JointPoses pose(const Posture& posture) const;
  /// The axis (hand frame, unit length) about which each angle turns its joint and what hangs on it, right-handed,
  /// in the pose of that posture.
  std::array<Eigen::Vector3d, kAngleCount> axes(const JointPoses& T_hand_joint) const;
  /// The angles at which the bind pose is reached.
  const Posture& bind_posture() const { return bind_posture_; }

  /// Where a joint lies in its parent's frame, in the hand frame if it has none, m. Another hand has other places.
  const Eigen::Vector3d& offset(int joint) const { return joints_.at(joint).offset; }
  void set_offset(int joint, const Eigen::Vector3d& offset) { joints_.at(joint).offset = offset; }

 private:
  struct Joint {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< in the parent's frame
    Eigen::Matrix3d before = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d after = Eigen::Matrix3d::Identity();
    int abduction = -1;  ///< index of the angle, or -1
    int flexion = -1;
  };

  std::array<Joint, kJointCount> joints_;
  Posture bind_posture_ = Posture::Zero();
};

}  // namespace glovebench
