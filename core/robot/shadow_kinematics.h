#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/robot/shadow_hand.h"

namespace glovebench {

/// Thumb to little; hand frame, m.
using Fingertips = Eigen::Matrix<double, 3, 5>;
/// Fingertip f (rows 3f to 3f + 2) by joint, m/rad.
using FingertipJacobian = Eigen::Matrix<double, 15, kShadowJointCount>;

/// Largest distance of fingertips from the hand's origin, and from WRJ2, m.
inline constexpr double kShadowHandReach = 0.15, kShadowWristReach = 0.23;

/// Shadow's palm (x to the thumb, y dorsal, z to the fingers, origin WRJ1).
const Eigen::Isometry3d& shadow_T_hand_palm();

/// Shadow's dimensions (sr_common, sr_description), right hand; a left hand mirrors x. The wrist does not move
/// fingertips.
Fingertips shadow_fingertips(const std::array<double, kShadowJointCount>& joints);
FingertipJacobian shadow_fingertip_jacobian(const std::array<double, kShadowJointCount>& joints);

/// The hand in WRJ2's frame, which is fixed to the forearm. With a straight wrist it has the palm's axes.
Eigen::Isometry3d shadow_T_wrist_hand(const std::array<double, kShadowJointCount>& joints);

}  // namespace glovebench
