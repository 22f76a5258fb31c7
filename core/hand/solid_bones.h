#pragma once

#include "core/base/recycled_vector.h"
#include "core/hand/skeleton.h"

namespace glovebench {

inline constexpr int kPalmOfBones = 5;  ///< after the five fingers, thumb first

/// Two bones that can collide: of two fingers, or of a finger and the palm. Around each lies a capsule as thick as
/// that part of a mean hand.
struct BonePair {
  std::array<int, 2> fingers;
  std::array<uint32_t, 2> angles;          ///< bits of the angles that move each bone
  std::array<Eigen::Vector3d, 2> nearest;  ///< points of the bones, hand frame, m
  double overlap;                          ///< of the capsules, m; negative: a gap
};

/// The pairs that overlap by more than `least`, m.
RecycledVector<BonePair> overlapping_bones(const JointPoses& T_hand_joint, double least);

}  // namespace glovebench
