#pragma once

#include <string>
#include <vector>

#include "core/hand/hand_model.h"
#include "render/subjects/hand_capsules.h"

namespace glovebench::render {

/// A gloved hand of another construction than the tracker's mesh: a smooth union of tapered capsules of
/// anthropometric dimensions. The seed draws the person, the skeleton and the glove.
///
/// A hand is polygonized once, with spread fingers. In a posture the capsules are placed at the skeleton's joints,
/// and each vertex is projected onto the smooth union of those that it joined when the fingers were spread
/// (Vaillant et al. 2013, "Implicit Skinning: Real-Time Skin Deformation with Contact Modeling", without contact).
/// Bones that are blended by weights only say where on that surface a piece of the glove goes.
class CapsuleHand {
 public:
  /// `definition` is the skeleton of the package's mesh, which defines the thumb's zero.
  CapsuleHand(uint64_t seed, Side side, const Skeleton& definition);

  /// The posture in which the hand is polygonized: fingers are spread, so that only what is grown together touches.
  static Posture rest_posture();

  PosedHand pose(const Posture& posture) const;
  /// The joints alone, which are quick to have.
  JointPoses joints(const Posture& posture) const;
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Hash of the surface, its folds and the skeleton.
  const std::string& hash() const { return hash_; }

  const HandDimensions& dimensions() const { return dimensions_; }
  /// Of the right hand; the left hand is its mirror image.
  const Skeleton& skeleton() const { return skeleton_; }
  const std::vector<HandCapsule>& capsules() const { return capsules_; }
  /// The field's value on which each vertex lies, m: the glove's thickness and its folds. The cuff's end, which is
  /// cut flat, has none (NaN).
  const std::vector<double>& levels() const { return levels_; }
  /// Smooth union of the placed capsules as vertex `v` sees it.
  FieldSample field_at(size_t v, const std::vector<Capsule>& placed, const Eigen::Vector3d& p) const;

 private:
  /// How much a vertex's place follows a joint.
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
  std::vector<Eigen::Vector3d> rest_;  ///< vertices with spread fingers, without folds
  std::vector<double> levels_;
  JointPoses T_joint_rest_;  ///< hand coordinates of the rest posture to joint coordinates
  std::vector<UnionPart> parts_;
  std::vector<uint32_t> first_part_;  ///< of each vertex, and the end
  std::vector<Follow> follows_;
  std::vector<uint32_t> first_follow_;  ///< of each vertex, and the end
  std::string hash_;
};

}  // namespace glovebench::render
