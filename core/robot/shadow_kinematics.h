#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/robot/shadow_hand.h"

namespace glovebench {

/// Where the five fingertips are, thumb to little, in the hand frame, m.
using Fingertips = Eigen::Matrix<double, 3, 5>;
/// How each fingertip's x, y, z (rows 3 f to 3 f + 2) changes with each joint, m/rad.
using FingertipJacobian = Eigen::Matrix<double, 15, kShadowJointCount>;

/// No fingertip is ever farther than this from the hand frame's origin, and from the wrist's first joint (WRJ2); m.
inline constexpr double kShadowHandReach = 0.15, kShadowWristReach = 0.23;

/// The robot's palm in its hand frame. Shadow's palm frame has x to the thumb, y dorsal, z to the fingers and its
/// origin at WRJ1. The hand frame is that of core/README.md, on the robot: axes along those, origin midway between
/// WRJ1 and the middle finger's knuckle. So the pose of a human hand is a pose for the robot's.
const Eigen::Isometry3d& shadow_T_hand_palm();

/// Forward kinematics of the right hand by Shadow's model (sr_common, sr_description: knuckles in the palm FF (33,
/// 0, 95), MF (11, 0, 99), RF (-11, 0, 95), LF (-33, 0, 86.5) through LFJ5 at (-33, 0, 20.7) about (0.574, 0,
/// 0.819); finger segments 45, 25, 26; thumb at (34, -8.5, 29), tilted by 45 degrees, segments 38, 32, 27.5; all
/// mm). A fingertip is the end of its last segment. The wrist moves none of them. The left hand is the mirror image
/// (x).
Fingertips shadow_fingertips(const std::array<double, kShadowJointCount>& joints);
FingertipJacobian shadow_fingertip_jacobian(const std::array<double, kShadowJointCount>& joints);

/// The hand in the frame of the wrist's first joint, WRJ2, which is fixed to the forearm and has the palm's axes
/// when the wrist is straight: 34 mm to WRJ1.
Eigen::Isometry3d shadow_T_wrist_hand(const std::array<double, kShadowJointCount>& joints);

}  // namespace glovebench
