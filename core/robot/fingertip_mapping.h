#pragma once

#include "core/hand/skeleton.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {

/// Fingertips of the right hand, hand frame, m.
Fingertips human_fingertips(const Skeleton& skeleton, const Posture& posture);

/// Maps a pinch to a pinch (core/robot/README.md); far from one, equals the direct mapping. Starts at the last
/// result and moves motors (not the wrist's) as little as possible.
class FingertipMapping {
 public:
  explicit FingertipMapping(Skeleton skeleton, ShadowCoupling coupling = ShadowCoupling::series)
      : skeleton_(std::move(skeleton)), coupling_(coupling) {}

  /// Flags a joint if the direct mapping's flag remains or the fit moved it to a limit.
  /// Throws: Error if an angle is not finite.
  ShadowHandTargets map(const Posture& posture);
  void reset() { last_.setZero(); }

 private:
  Skeleton skeleton_;
  ShadowCoupling coupling_;
  /// Last result minus direct mapping, rad.
  Eigen::Matrix<double, kShadowActuatorCount, 1> last_ = Eigen::Matrix<double, kShadowActuatorCount, 1>::Zero();
};

}  // namespace glovebench
