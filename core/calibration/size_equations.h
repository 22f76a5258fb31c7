#pragma once

#include <vector>

#include "core/calibration/hand_fit.h"

namespace glovebench::calibration {

using SizeVector = Eigen::Matrix<double, kSizeCount, 1>;
using SizeMatrix = Eigen::Matrix<double, kSizeCount, kSizeCount>;

/// How the posed surface moves with each angle and each size: differences between posed hands.
class SurfaceMotion {
 public:
  explicit SurfaceMotion(const HandModel& model);

  static constexpr int kMoves = kAngleCount + kSizeCount;
  /// What each vertex does, vertex by vertex: kMoves vectors, mm a degree and mm a percent, hand frame.
  std::vector<Eigen::Vector3f> at(const Posture& posture, const PosedHand& hand) const;
  const HandModel& model() const { return model_; }

 private:
  const HandModel& model_;
  std::vector<HandModel> stretched_;  ///< one a size, by a percent
};

/// The normal equations of one view: for the sizes with pose and posture eliminated, H sizes = g, and the step of
/// pose and posture that goes with a step of the sizes. Sizes in percent, others as in articulated_step.h.
struct SizeEquations {
  SizeMatrix H = SizeMatrix::Zero();
  SizeVector g = SizeVector::Zero();
  StepVector pose_step = StepVector::Zero();
  Eigen::Matrix<double, kUnknowns, kSizeCount> pose_by_sizes = Eigen::Matrix<double, kUnknowns, kSizeCount>::Zero();

  StepVector step(const SizeVector& sizes) const { return pose_step - pose_by_sizes * sizes; }
};
/// `tukey_mm`: farther points have no weight. The weights are those of 1,000 points, however many there are.
SizeEquations size_equations(const SurfaceMotion& motion, const TrackedView& view, const ArticulatedPose& pose,
                             double tukey_mm);

}  // namespace glovebench::calibration
