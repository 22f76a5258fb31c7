#include "core/hand/skeleton.h"

#include "core/base/error.h"

namespace glovebench {
namespace {

struct JointEntry {
  std::string name;
  int parent;
  int abduction;
  int flexion;
};

constexpr int kNone = -1;

// The file's joints are siblings: the tree stands here.
const std::array<JointEntry, kJointCount>& entries() {
  static const std::array<JointEntry, kJointCount> table = {{
      {"wrist", kNone, kNone, kNone},
      {"thumb-metacarpal", kNone, kThumbCmcAbduction, kThumbCmcFlexion},
      {"thumb-phalanx-proximal", 1, kNone, kThumbMcpFlexion},
      {"thumb-phalanx-distal", 2, kNone, kThumbIpFlexion},
      {"thumb-tip", 3, kNone, kNone},
      {"index-finger-metacarpal", kNone, kNone, kNone},
      {"index-finger-phalanx-proximal", kNone, kIndexMcpAbduction, kIndexMcpFlexion},
      {"index-finger-phalanx-intermediate", 6, kNone, kIndexPipFlexion},
      {"index-finger-phalanx-distal", 7, kNone, kIndexDipFlexion},
      {"index-finger-tip", 8, kNone, kNone},
      {"middle-finger-metacarpal", kNone, kNone, kNone},
      {"middle-finger-phalanx-proximal", kNone, kMiddleMcpAbduction, kMiddleMcpFlexion},
      {"middle-finger-phalanx-intermediate", 11, kNone, kMiddlePipFlexion},
      {"middle-finger-phalanx-distal", 12, kNone, kMiddleDipFlexion},
      {"middle-finger-tip", 13, kNone, kNone},
      {"ring-finger-metacarpal", kNone, kNone, kNone},
      {"ring-finger-phalanx-proximal", kNone, kRingMcpAbduction, kRingMcpFlexion},
      {"ring-finger-phalanx-intermediate", 16, kNone, kRingPipFlexion},
      {"ring-finger-phalanx-distal", 17, kNone, kRingDipFlexion},
      {"ring-finger-tip", 18, kNone, kNone},
      {"pinky-finger-metacarpal", kNone, kNone, kNone},
      {"pinky-finger-phalanx-proximal", kNone, kLittleMcpAbduction, kLittleMcpFlexion},
      {"pinky-finger-phalanx-intermediate", 21, kNone, kLittlePipFlexion},
      {"pinky-finger-phalanx-distal", 22, kNone, kLittleDipFlexion},
      {"pinky-finger-tip", 23, kNone, kNone},
      {"forearm", kNone, kWristAbduction, kWristFlexion},
  }};
  return table;
}

Eigen::Matrix3d turn_y(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
}
Eigen::Matrix3d turn_x(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
}

/// R = R_y(abduction) * R_x(-flexion) * R_z(twist).
struct Decomposition {
  double abduction;
  double flexion;
  Eigen::Matrix3d twist;
};
Decomposition decompose(const Eigen::Matrix3d& R) {
  Decomposition d;
  d.flexion = std::asin(std::clamp(R(1, 2), -1.0, 1.0));
  d.abduction = std::atan2(R(0, 2), R(2, 2));
  d.twist = (turn_y(d.abduction) * turn_x(-d.flexion)).transpose() * R;
  return d;
}

}  // namespace

const std::string& joint_name(int joint) { return entries().at(joint).name; }

int joint_index(const std::string& webxr_name) {
  for (int j = 0; j < kJointCount; ++j)
    if (entries()[j].name == webxr_name) return j;
  throw Error("joint", "name", webxr_name, "a WebXR hand joint");
}

const std::array<int, kJointCount>& joint_parents() {
  static const std::array<int, kJointCount> parents = [] {
    std::array<int, kJointCount> result;
    for (int j = 0; j < kJointCount; ++j) result[j] = entries()[j].parent;
    return result;
  }();
  return parents;
}

int joint_of_angle(int angle) {
  for (int j = 0; j < kJointCount; ++j)
    if (entries()[j].abduction == angle || entries()[j].flexion == angle) return j;
  throw std::out_of_range("joint_of_angle: no such angle");
}

const std::array<int, 5>& fingertip_joints() {
  static constexpr std::array<int, 5> tips = {4, 9, 14, 19, 24};
  return tips;
}

Skeleton::Skeleton(const JointPoses& T_hand_joint_bind) {
  for (int j = 0; j < kJointCount; ++j) {
    const JointEntry& entry = entries()[j];
    const Eigen::Isometry3d T_parent_joint = entry.parent == kNone
                                                 ? T_hand_joint_bind[j]
                                                 : T_hand_joint_bind[entry.parent].inverse() * T_hand_joint_bind[j];
    Joint& joint = joints_[j];
    joint.offset = T_parent_joint.translation();
    joint.abduction = entry.abduction;
    joint.flexion = entry.flexion;
    const Eigen::Matrix3d R = T_parent_joint.linear();
    const bool keeps_bind = entry.flexion == kNone || entry.flexion == kThumbCmcFlexion;
    if (keeps_bind) {
      joint.before = R;
      continue;
    }
    const Decomposition bind = decompose(R);
    joint.after = bind.twist;
    bind_posture_[entry.flexion] = bind.flexion;
    // A hinge keeps the sideways bend of the bind pose; a base joint has an angle for it.
    if (entry.abduction == kNone) joint.before = turn_y(bind.abduction);
    if (entry.abduction != kNone) bind_posture_[entry.abduction] = bind.abduction;
  }
}

JointPoses Skeleton::pose(const Posture& posture) const {
  JointPoses T_hand_joint;
  for (int j = 0; j < kJointCount; ++j) {
    const Joint& joint = joints_[j];
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    if (joint.abduction != kNone) R = turn_y(posture[joint.abduction]);
    if (joint.flexion != kNone) R = R * turn_x(-posture[joint.flexion]);
    // The pose is rooted at the hand: a flexed wrist turns the forearm the other way.
    if (j == kForearmJoint) R.transposeInPlace();
    Eigen::Isometry3d T_parent_joint = Eigen::Isometry3d::Identity();
    T_parent_joint.linear() = joint.before * R * joint.after;
    T_parent_joint.translation() = joint.offset;
    const int parent = entries()[j].parent;
    T_hand_joint[j] = parent == kNone ? T_parent_joint : T_hand_joint[parent] * T_parent_joint;
  }
  return T_hand_joint;
}

std::array<Eigen::Vector3d, kAngleCount> Skeleton::axes(const JointPoses& T_hand_joint) const {
  std::array<Eigen::Vector3d, kAngleCount> axes;
  for (int j = 0; j < kJointCount; ++j) {
    const Joint& joint = joints_[j];
    const int parent = entries()[j].parent;
    // The first of the two turns keeps its axis in the parent, the second one in the joint; the forearm's are
    // inverse.
    const Eigen::Matrix3d R_parent =
        parent == kNone ? Eigen::Matrix3d::Identity() : Eigen::Matrix3d(T_hand_joint[parent].linear());
    const Eigen::Matrix3d first = R_parent * joint.before;
    const Eigen::Matrix3d second = T_hand_joint[j].linear() * joint.after.transpose();
    const bool is_forearm = j == kForearmJoint;
    if (joint.abduction != kNone) {
      axes[joint.abduction] = first.col(1);
      if (is_forearm) axes[joint.abduction] = -second.col(1);
    }
    if (joint.flexion != kNone) {
      axes[joint.flexion] = -second.col(0);
      if (is_forearm) axes[joint.flexion] = first.col(0);
    }
  }
  return axes;
}

}  // namespace glovebench
