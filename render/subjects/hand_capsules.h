#pragma once

#include <vector>

#include "core/hand/skeleton.h"
#include "render/subjects/capsule_field.h"
#include "render/subjects/hand_dimensions.h"

namespace glovebench::render {

struct CapsuleEnd {
  int joint = kWristJoint;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< in the joint's frame, m
  /// added if the palm is fully arched, m
  Eigen::Vector3d arched = Eigen::Vector3d::Zero();
};

/// May span several joints and deform (webs, pads).
struct HandCapsule {
  CapsuleEnd a;
  CapsuleEnd b;
  double radius_a = 0;
  double radius_b = 0;
  Joining joining = Joining::palm;
  int ray = 0;  ///< 0 thumb .. 4 little, -1 none
};

/// Without the glove.
std::vector<HandCapsule> make_capsules(const HandDimensions& hand, const Skeleton& skeleton);

std::vector<Capsule> place_capsules(const std::vector<HandCapsule>& capsules, const JointPoses& T_hand_joint,
                                    const Posture& posture);

}  // namespace glovebench::render
