#pragma once

#include <string>
#include <vector>

#include "core/hand/hand_model.h"
#include "render/subjects/hand_capsules.h"

namespace glovebench::render {

/// A gloved hand of capsules (render/README.md), drawn by the seed. A posture moves the capsules and projects
/// vertices onto their union (Vaillant et al. 2013, "Implicit Skinning", without contact).
class CapsuleHand {
 public:
  /// `definition`: defines the thumb's zero.
  CapsuleHand(uint64_t seed, Side side, const Skeleton& definition);

  /// Spread fingers.
  static Posture rest_posture();

  PosedHand pose(const Posture& posture) const;
  /// Faster than `pose`.
  JointPoses joints(const Posture& posture) const;
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::string& hash() const { return hash_; }

  const HandDimensions& dimensions() const { return dimensions_; }
  /// The right hand's; a left hand mirrors it.
  const Skeleton& skeleton() const { return skeleton_; }
  const std::vector<HandCapsule>& capsules() const { return capsules_; }
  /// Field value at each vertex (glove, folds), m. NaN at the cuff's flat end.
  const std::vector<double>& levels() const { return levels_; }
  /// The field that vertex `v` follows.
  FieldSample field_at(size_t v, const std::vector<Capsule>& placed, const Eigen::Vector3d& p) const;

 private:
  struct Follow {
    uint8_t joint = 0;
    float weight = 0;
  };
  void polygonize(uint64_t seed);
  void join_capsules(const std::vector<Capsule>& rest, const Eigen::Vector3d& p);
  std::string make_hash() const;
  std::span<const UnionPart> parts_of(size_t v) const {
    return {parts_.data() + first_part_[v], first_part_[v + 1] - first_part_[v]};
  }

  Side side_;
  HandDimensions dimensions_;
  Skeleton skeleton_;
  std::vector<HandCapsule> capsules_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> rest_;
  std::vector<double> levels_;
  JointPoses T_joint_rest_;
  std::vector<UnionPart> parts_;
  std::vector<uint32_t> first_part_;
  std::vector<Follow> follows_;
  std::vector<uint32_t> first_follow_;
  std::string hash_;
};

}  // namespace glovebench::render
