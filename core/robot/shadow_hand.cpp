#include "core/robot/shadow_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/math.h"

namespace glovebench {
namespace {

double right_angle() { return radians_from_degrees(90); }

/// Not more than the other half, also of a number that cannot be halved.
double half(double motor) { return std::min(motor / 2, motor - motor / 2); }

double lower_limit(ShadowJoint joint) { return radians_from_degrees(shadow_joint_infos()[joint].min_deg); }
double upper_limit(ShadowJoint joint) { return radians_from_degrees(shadow_joint_infos()[joint].max_deg); }

/// What the posture asks of a joint, rad; zero without a source.
double wanted_angle(const Posture& posture, ShadowJoint joint) {
  const ShadowJointInfo& info = shadow_joint_infos()[joint];
  if (!info.source) return 0;
  const double wanted = info.sign * posture[*info.source];
  if (!std::isfinite(wanted))
    throw Error("robot command", std::string(angle_infos()[*info.source].name), fmt::format("{}", wanted),
                "a finite angle");
  return wanted;
}

}  // namespace

CoupledJoints split_motor(double motor, ShadowCoupling coupling) {
  if (coupling == ShadowCoupling::even) return {half(motor), motor - half(motor)};
  // From 90 to 180 degrees the difference is exact, and so is the sum.
  return {std::max(motor - right_angle(), 0.0), std::min(motor, right_angle())};
}

double distal_share(double motor, ShadowCoupling coupling) {
  if (coupling == ShadowCoupling::even) return 0.5;
  return motor < right_angle() ? 0 : 1;
}

CoupledJoints between(const CoupledJoints& from, const CoupledJoints& to, double share, ShadowCoupling coupling) {
  const double start = from.distal + from.proximal, end = to.distal + to.proximal;
  const auto [lowest, highest] = std::minmax(start, end);
  const double motor = std::clamp(start + share * (end - start), lowest, highest);
  const double off_model = (1 - share) * (from.distal - split_motor(start, coupling).distal) +
                           share * (to.distal - split_motor(end, coupling).distal);
  const double distal = std::clamp(split_motor(motor, coupling).distal + off_model,
                                   std::max(motor - right_angle(), 0.0), half(motor));
  return {distal, motor - distal};
}

const std::array<ShadowJointInfo, kShadowJointCount>& shadow_joint_infos() {
  static constexpr std::array<ShadowJointInfo, kShadowJointCount> infos = {{
      {"FFJ1", 0, 90, kIndexDipFlexion, +1},    {"FFJ2", 0, 90, kIndexPipFlexion, +1},
      {"FFJ3", -15, 90, kIndexMcpFlexion, +1},  {"FFJ4", -20, 20, kIndexMcpAbduction, -1},
      {"MFJ1", 0, 90, kMiddleDipFlexion, +1},   {"MFJ2", 0, 90, kMiddlePipFlexion, +1},
      {"MFJ3", -15, 90, kMiddleMcpFlexion, +1}, {"MFJ4", -20, 20, kMiddleMcpAbduction, -1},
      {"RFJ1", 0, 90, kRingDipFlexion, +1},     {"RFJ2", 0, 90, kRingPipFlexion, +1},
      {"RFJ3", -15, 90, kRingMcpFlexion, +1},   {"RFJ4", -20, 20, kRingMcpAbduction, +1},
      {"LFJ1", 0, 90, kLittleDipFlexion, +1},   {"LFJ2", 0, 90, kLittlePipFlexion, +1},
      {"LFJ3", -15, 90, kLittleMcpFlexion, +1}, {"LFJ4", -20, 20, kLittleMcpAbduction, +1},
      {"LFJ5", 0, 45, std::nullopt, +1},  // fold of the palm: the model's palm is rigid
      {"THJ1", -15, 90, kThumbIpFlexion, +1},   {"THJ2", -40, 40, kThumbMcpFlexion, +1},
      {"THJ3", -12, 12, std::nullopt, +1},  // sideways at the thumb's MCP: a hinge in the model
      {"THJ4", 0, 70, kThumbCmcAbduction, +1},  {"THJ5", -60, 60, kThumbCmcFlexion, +1},
      {"WRJ1", -40, 28, kWristFlexion, +1},     {"WRJ2", -28, 10, kWristAbduction, +1},
  }};
  return infos;
}

const std::array<ShadowActuatorInfo, kShadowActuatorCount>& shadow_actuator_infos() {
  static constexpr std::array<ShadowActuatorInfo, kShadowActuatorCount> infos = {{
      {"FFJ0", kFFJ2, kFFJ1},        {"FFJ3", kFFJ3, std::nullopt}, {"FFJ4", kFFJ4, std::nullopt},
      {"MFJ0", kMFJ2, kMFJ1},        {"MFJ3", kMFJ3, std::nullopt}, {"MFJ4", kMFJ4, std::nullopt},
      {"RFJ0", kRFJ2, kRFJ1},        {"RFJ3", kRFJ3, std::nullopt}, {"RFJ4", kRFJ4, std::nullopt},
      {"LFJ0", kLFJ2, kLFJ1},        {"LFJ3", kLFJ3, std::nullopt}, {"LFJ4", kLFJ4, std::nullopt},
      {"LFJ5", kLFJ5, std::nullopt}, {"THJ1", kTHJ1, std::nullopt}, {"THJ2", kTHJ2, std::nullopt},
      {"THJ3", kTHJ3, std::nullopt}, {"THJ4", kTHJ4, std::nullopt}, {"THJ5", kTHJ5, std::nullopt},
      {"WRJ1", kWRJ1, std::nullopt}, {"WRJ2", kWRJ2, std::nullopt},
  }};
  return infos;
}

void make_actuators(ShadowHandTargets& hand) {
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
    hand.actuators[a] = hand.joints[info.joint];
    if (info.coupled_joint) hand.actuators[a] += hand.joints[*info.coupled_joint];
  }
}

ShadowHandTargets map_to_shadow_hand(const Posture& posture, ShadowCoupling coupling) {
  ShadowHandTargets targets;
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
    double wanted = wanted_angle(posture, info.joint);
    double lowest = lower_limit(info.joint), highest = upper_limit(info.joint);
    if (info.coupled_joint) {
      wanted += wanted_angle(posture, *info.coupled_joint);
      lowest += lower_limit(*info.coupled_joint);
      highest += upper_limit(*info.coupled_joint);
    }
    const double motor = std::clamp(wanted, lowest, highest);
    const bool clamped = targets.actuator_clamped[a] = targets.joint_clamped[info.joint] = motor != wanted;
    targets.joints[info.joint] = motor;
    if (!info.coupled_joint) continue;
    targets.joint_clamped[*info.coupled_joint] = clamped;
    const CoupledJoints joints = split_motor(motor, coupling);
    targets.joints[info.joint] = joints.proximal;
    targets.joints[*info.coupled_joint] = joints.distal;
  }
  make_actuators(targets);
  return targets;
}

}  // namespace glovebench
