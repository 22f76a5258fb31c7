#pragma once

#include "core/hand/skeleton.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {

/// Fingertips of the human hand in that posture (right hand; thumb to little).
Fingertips human_fingertips(const Skeleton& skeleton, const Posture& posture);

/// Maps postures so that what the thumb pinches stays pinched. Bones and thumb base of the robot differ from the
/// hand's, so equal angles leave its fingertips apart (core/robot/README.md: by how much).
///
/// Where thumb and finger of the human hand are close, the robot's thumb-to-finger vector is fitted to the human
/// one; far apart they are as `map_to_shadow_hand` leaves them; between, the vector goes from one to the other. The
/// motors move as little from the direct mapping as that needs: damped Gauss-Newton (Levenberg-Marquardt) over all
/// motors but the wrist's, whose joints follow by the coupling; steps are projected into the limits; it starts from
/// the last posture's result.
class FingertipMapping {
 public:
  explicit FingertipMapping(Skeleton skeleton, ShadowCoupling coupling = ShadowCoupling::series)
      : skeleton_(std::move(skeleton)), coupling_(coupling) {}

  /// Throws Error if an angle is not finite. A joint is flagged where the direct mapping flags it and the fit
  /// leaves it so, and where the fit moved it to a limit.
  ShadowHandTargets map(const Posture& posture);
  /// The next posture has none before it.
  void reset() { last_.setZero(); }

 private:
  Skeleton skeleton_;
  ShadowCoupling coupling_;
  /// How far the motors were from the direct mapping, rad.
  Eigen::Matrix<double, kShadowActuatorCount, 1> last_ = Eigen::Matrix<double, kShadowActuatorCount, 1>::Zero();
};

}  // namespace glovebench
