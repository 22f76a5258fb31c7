#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/base/enum_names.h"
#include "core/hand/posture.h"

namespace glovebench {

/// How J1 and J2 of a finger share their motor's angle (core/robot/README.md).
enum class ShadowCoupling {
  series,  ///< J2 to 90 degrees, then J1
  even,
};
constexpr auto names_of(ShadowCoupling) { return std::to_array<std::string_view>({"series", "even"}); }

/// A finger's last two, rad.
struct CoupledJoints {
  double distal;    ///< J1, never above J2
  double proximal;  ///< J2
};
/// `motor`: target, 0 to pi rad. J1 + J2 equals it exactly.
CoupledJoints split_motor(double motor, ShadowCoupling coupling);
/// J1's share of a small motion, 0 to 1.
double distal_share(double motor, ShadowCoupling coupling);

/// The joints at a share (0 to 1) of the way. The motor moves linearly. If `from` does not follow the coupling,
/// its deviation fades. J1 never exceeds J2.
CoupledJoints between(const CoupledJoints& from, const CoupledJoints& to, double share, ShadowCoupling coupling);

/// J1 is a finger's last joint, J4 its spread.
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

/// Robot angle = sign * human angle. Positive: THJ5 turns the thumb across the palm, THJ4 lifts it off, WRJ1 bends
/// to the palm, WRJ2 turns to the thumb.
struct ShadowJointInfo {
  std::string_view name;
  double min_deg;
  double max_deg;
  std::optional<Angle> source;  ///< empty: stays at zero
  int sign;                     ///< +1 or -1
};
const std::array<ShadowJointInfo, kShadowJointCount>& shadow_joint_infos();

/// The target of a motor of two joints (J0) is their sum.
struct ShadowActuatorInfo {
  std::string_view name;
  ShadowJoint joint;
  std::optional<ShadowJoint> coupled_joint;  ///< J1 if `joint` is J2
};
const std::array<ShadowActuatorInfo, kShadowActuatorCount>& shadow_actuator_infos();

/// Within limits, rad. `clamped`: changed by them.
struct ShadowHandTargets {
  std::array<double, kShadowJointCount> joints{};
  std::array<bool, kShadowJointCount> joint_clamped{};
  std::array<double, kShadowActuatorCount> actuators{};
  std::array<bool, kShadowActuatorCount> actuator_clamped{};
};

/// Computes the motors' targets from the joints'.
void make_actuators(ShadowHandTargets& hand);

/// Each joint takes its source's angle, clamped. The coupling splits the clamped J1 + J2.
/// Throws: Error if an angle is not finite.
/// Paper: section V.
ShadowHandTargets map_to_shadow_hand(const Posture& posture, ShadowCoupling coupling = ShadowCoupling::series);

}  // namespace glovebench
