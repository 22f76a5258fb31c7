#pragma once

#include <string>
#include <vector>

#include "core/hand/glove.h"
#include "render/subjects/hand_capsules.h"

namespace glovebench::render {

/// m
inline constexpr double kGloveThickness = 0.001;
/// Range of folds and border shifts, m.
inline constexpr double kLeastFold = 0.001, kMostFold = 0.002;
inline constexpr double kMostBorderShift = 0.003;

/// Lattice noise in [-1, 1]. `scale`: lattice step, m.
double smooth_noise(uint64_t seed, const Eigen::Vector3d& p, const Eigen::Vector3d& scale);

class CapsuleGlove {
 public:
  CapsuleGlove(const std::vector<HandCapsule>& capsules, std::vector<Capsule> placed,
               const JointPoses& T_hand_joint, uint64_t seed);

  /// As `patch_scores`, with borders near the joints.
  PatchScores scores(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;

  /// Folds across the fingers, m, mean 0.
  std::vector<double> folds(const std::vector<Eigen::Vector3d>& places) const;

 private:
  double shift(int border, const Eigen::Vector3d& p) const;
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
