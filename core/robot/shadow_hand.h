#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/base/enum_names.h"
#include "core/hand/posture.h"

namespace glovebench {

/// How one motor moves the last two joints of a finger while nothing stands in their way. Its target is J0 = J1 +
/// J2, 0 to 180 degrees; J1 and J2 cannot be commanded apart (github.com/shadow-robot/sr_core, issue 150).
enum class ShadowCoupling {
  series,  ///< J2 alone until it is at 90 degrees, then J1: google-deepmind/mujoco_menagerie issue 132, one report
           ///< of a real hand, not verified against the maker's manual
  even,    ///< both alike, as published simulation models do
};
constexpr auto names_of(ShadowCoupling) {
  return std::to_array<std::string_view>({"series", "even"});
}

/// The last two joints of a finger, rad.
struct CoupledJoints {
  double distal;    ///< J1, which is never above J2
  double proximal;  ///< J2
};
/// The joints of a motor at `motor`, 0 to pi rad. Their sum is `motor`, to the last bit.
CoupledJoints split_motor(double motor, ShadowCoupling coupling);
/// J1's share of a small motion of the motor from there, 0 to 1; J2 has the rest.
double distal_share(double motor, ShadowCoupling coupling);

/// A share (0 to 1) of the way between two states of such joints. The motor goes straight. What the first state is
/// off the model, as a finger that touches something is, fades by the same share. Both joints stay within their
/// limits and J1 stays under J2.
CoupledJoints between(const CoupledJoints& from, const CoupledJoints& to, double share, ShadowCoupling coupling);

/// The 24 joints of a Shadow Dexterous Hand. J1 of a finger is its last joint, J4 its spread.
// clang-format off: one finger a row
enum ShadowJoint : int {
  kFFJ1,
  kFFJ2,
  kFFJ3,
  kFFJ4,
  kMFJ1,
  kMFJ2,
  kMFJ3,
  kMFJ4,
  kRFJ1,
  kRFJ2,
  kRFJ3,
  kRFJ4,
  kLFJ1,
  kLFJ2,
  kLFJ3,
  kLFJ4,
  kLFJ5,
  kTHJ1,
  kTHJ2,
  kTHJ3,
  kTHJ4,
  kTHJ5,
  kWRJ1,
  kWRJ2,
};
// clang-format on
inline constexpr int kShadowJointCount = 24;
inline constexpr int kShadowActuatorCount = 20;

/// A joint of the robot: its limits and the human angle that drives it. Robot angle = sign * human angle.
/// Spread (J4) counts towards the thumb as negative on the first and middle finger, as positive on the ring and
/// little finger; THJ5 turns the thumb across the palm, THJ4 lifts it off the palm; WRJ1 bends to the palm and
/// WRJ2 turns towards the thumb.
struct ShadowJointInfo {
  std::string_view name;
  double min_deg;
  double max_deg;
  std::optional<Angle> source;  ///< none: the hand model has no such angle, the joint stays at zero
  int sign;                     ///< +1 or -1
};
const std::array<ShadowJointInfo, kShadowJointCount>& shadow_joint_infos();

/// A motor of the robot. J0 of a finger drives two joints by one tendon: its target is their sum (ShadowCoupling).
struct ShadowActuatorInfo {
  std::string_view name;
  ShadowJoint joint;
  std::optional<ShadowJoint> coupled_joint;  ///< J1 of the finger whose J2 is `joint`
};
const std::array<ShadowActuatorInfo, kShadowActuatorCount>& shadow_actuator_infos();

/// Targets within the limits, rad, with a flag for each that is not what the posture asked for.
struct ShadowHandTargets {
  std::array<double, kShadowJointCount> joints{};
  std::array<bool, kShadowJointCount> joint_clamped{};
  std::array<double, kShadowActuatorCount> actuators{};
  std::array<bool, kShadowActuatorCount> actuator_clamped{};
};

/// Gives each motor the target that follows from its joints'.
void make_actuators(ShadowHandTargets& hand);

/// The direct mapping of section V. Each joint takes the angle of its source, clamped to its limits. J1 and J2 of a
/// finger are what the coupling makes of their motor's target, the sum of their sources' angles clamped to its
/// limits; they count as clamped where the motor does. Throws Error if an angle is not finite.
ShadowHandTargets map_to_shadow_hand(const Posture& posture, ShadowCoupling coupling = ShadowCoupling::series);

}  // namespace glovebench
