#pragma once

#include "core/hand/skeleton.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {

/// Fingertips of the right human hand, thumb to little, in the hand frame.
/// Units: m.
Fingertips human_fingertips(const Skeleton& skeleton, const Posture& posture);

/// Maps postures so that a pinch stays a pinch (core/robot/README.md). Near the thumb, the vector from thumb to
/// finger is fitted; farther away it fades into the direct mapping. Levenberg-Marquardt, from the last result,
/// moves the motors but the wrist's as little as possible.
class FingertipMapping {
 public:
  explicit FingertipMapping(Skeleton skeleton, ShadowCoupling coupling = ShadowCoupling::series)
      : skeleton_(std::move(skeleton)), coupling_(coupling) {}

  /// A joint is flagged if the fit left the direct mapping's flag or moved the joint to a limit.
  /// Throws: Error if an angle is not finite.
  ShadowHandTargets map(const Posture& posture);
  /// Forgets the last posture.
  void reset() { last_.setZero(); }

 private:
  Skeleton skeleton_;
  ShadowCoupling coupling_;
  /// The last result minus the direct mapping, rad.
  Eigen::Matrix<double, kShadowActuatorCount, 1> last_ = Eigen::Matrix<double, kShadowActuatorCount, 1>::Zero();
};

}  // namespace glovebench
