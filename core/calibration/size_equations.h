#pragma once

#include <vector>

#include "core/calibration/hand_fit.h"

namespace glovebench::calibration {

using SizeVector = Eigen::Matrix<double, kSizeCount, 1>;
using SizeMatrix = Eigen::Matrix<double, kSizeCount, kSizeCount>;

/// Derivatives of the surface by angles and sizes (differences).
class SurfaceMotion {
 public:
  explicit SurfaceMotion(const HandModel& model);

  static constexpr int kMoves = kAngleCount + kSizeCount;
  /// kMoves vectors per vertex, hand frame: mm per degree, mm per percent.
  std::vector<Eigen::Vector3f> at(const Posture& posture, const PosedHand& hand) const;
  const HandModel& model() const { return model_; }

 private:
  const HandModel& model_;
  std::vector<HandModel> stretched_;
};

/// Normal equations of one view: H sizes = g, pose and posture eliminated; also their step for a step of the
/// sizes. Sizes in percent; other units as in articulated_step.h.
struct SizeEquations {
  SizeMatrix H = SizeMatrix::Zero();
  SizeVector g = SizeVector::Zero();
  StepVector pose_step = StepVector::Zero();
  Eigen::Matrix<double, kUnknowns, kSizeCount> pose_by_sizes = Eigen::Matrix<double, kUnknowns, kSizeCount>::Zero();

  StepVector step(const SizeVector& sizes) const { return pose_step - pose_by_sizes * sizes; }
};
/// `tukey_mm`: farther points have no weight. All points together count 1,000.
SizeEquations size_equations(const SurfaceMotion& motion, const TrackedView& view, const ArticulatedPose& pose,
                             double tukey_mm);

}  // namespace glovebench::calibration
