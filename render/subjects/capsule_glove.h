#pragma once

#include <string>
#include <vector>

#include "core/hand/glove.h"
#include "render/subjects/hand_capsules.h"

namespace glovebench::render {

/// The glove's thickness, m.
inline constexpr double kGloveThickness = 0.001;
/// Bounds of what the seed draws, m: how deep folds are, and how far borders lie from where the layout has them.
inline constexpr double kLeastFold = 0.001, kMostFold = 0.002;
inline constexpr double kMostBorderShift = 0.003;

/// A smooth random function of place: lattice values in [-1, 1], interpolated. `scale` is the lattice's step, m.
double smooth_noise(uint64_t seed, const Eigen::Vector3d& p, const Eigen::Vector3d& scale);

/// The glove on a hand in one posture: a function of places on its surface. It moves with them.
class CapsuleGlove {
 public:
  CapsuleGlove(const std::vector<HandCapsule>& capsules, std::vector<Capsule> placed,
               const JointPoses& T_hand_joint, uint64_t seed);

  /// How strongly a place belongs to each patch, as `patch_scores` of the tracker's mesh: borders between segments
  /// lie at the joints, those of proximal segments 4 mm (thumb: 2 mm) past them, the thenar begins 24 mm from the
  /// wrist, front and back part where the normal is level, radial and ulnar side at the middle MCP, the cuff begins
  /// 2 mm past the wrist. Each border is shifted by up to 3 mm, part of it along its whole length.
  PatchScores scores(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;

  /// Height of the folds, m, for each place: folds run across the fingers; from the lowest to the highest place it
  /// is 1 to 2 mm, and the mean is 0.
  std::vector<double> folds(const std::vector<Eigen::Vector3d>& places) const;

 private:
  /// Of a border: its own part and one that changes along it.
  double shift(int border, const Eigen::Vector3d& p) const;
  /// Share of each ray, thumb to little; they add up to 1.
  std::array<double, 5> ray_shares(const Eigen::Vector3d& p) const;

  const std::vector<HandCapsule>& capsules_;
  std::vector<Capsule> placed_;
  JointPoses T_joint_hand_;
  double z_wrist_;
  double x_middle_;
  uint64_t seed_;
  std::array<double, kPatchCount> own_shift_{};
  double fold_depth_;
};

}  // namespace glovebench::render
