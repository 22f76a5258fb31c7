#pragma once

#include <vector>

#include "core/hand/skeleton.h"
#include "render/subjects/capsule_field.h"
#include "render/subjects/hand_dimensions.h"

namespace glovebench::render {

/// Where an end of a capsule is: fixed to a joint, or to the palm (the wrist joint).
struct CapsuleEnd {
  int joint = kWristJoint;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< in the joint's frame, m
  /// Added to `place` when the palm is fully arched, m.
  Eigen::Vector3d arched = Eigen::Vector3d::Zero();
};

/// A capsule of the hand. Both ends of one that belongs to a segment are fixed to its joint; webs, thenar and the
/// palm's pads span several and deform.
struct HandCapsule {
  CapsuleEnd a;
  CapsuleEnd b;
  double radius_a = 0;
  double radius_b = 0;
  Joining joining = Joining::palm;
  int ray = 0;  ///< which finger's ray of the palm or finger it belongs to: 0 thumb .. 4 little, -1 none
};

/// The capsules of a hand. Their radii make the union as wide as `hand` says, without the glove.
std::vector<HandCapsule> make_capsules(const HandDimensions& hand, const Skeleton& skeleton);

/// The capsules where the joints are in this posture.
std::vector<Capsule> place_capsules(const std::vector<HandCapsule>& capsules, const JointPoses& T_hand_joint,
                                    const Posture& posture);

}  // namespace glovebench::render
