#include "core/robot/guarded_place.h"

#include "core/base/angles.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

/// A motor's target may differ by what rounding to 1e-6 degrees of two joints and of itself makes, and no more. J1
/// and J2 may be as far from their model.
constexpr double kActuatorTolerance = 1e-6;  // rad
/// As `RobotCommander` admits it of a transform.
constexpr double kRotationTolerance = 1e-6;

template <typename Range>
bool all_finite(const Range& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Makes J1 and J2 what their motor makes of them. Whether that moves any by more than rounding.
bool couple(std::array<double, kShadowJointCount>& joints, ShadowCoupling coupling) {
  bool moved = false;
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    double& proximal = joints[info.joint];
    double& distal = joints[*info.coupled_joint];
    const CoupledJoints split = split_motor(proximal + distal, coupling);
    moved |= std::abs(split.distal - distal) > kActuatorTolerance;
    proximal = split.proximal;
    distal = split.distal;
  }
  return moved;
}

bool has_distal_above_proximal(const std::array<double, kShadowJointCount>& joints) {
  return std::ranges::any_of(shadow_actuator_infos(), [&](const ShadowActuatorInfo& info) {
    return info.coupled_joint && joints[*info.coupled_joint] > joints[info.joint] + kActuatorTolerance;
  });
}

ShadowHandTargets within_limits(const ShadowHandTargets& targets, ShadowCoupling coupling, Interventions& done) {
  ShadowHandTargets hand = targets;
  for (int j = 0; j < kShadowJointCount; ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    hand.joints[j] =
        std::clamp(hand.joints[j], radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg));
  }
  const bool above = has_distal_above_proximal(hand.joints);
  const bool limited = above || hand.joints != targets.joints;
  const bool coupled = couple(hand.joints, coupling);
  make_actuators(hand);
  if (limited) done.add(Intervention::joint_limit);
  if (coupled && !above) done.add(Intervention::coupling);
  if (limited || coupled) {
    flag_changes(hand, targets.joints);
    return hand;
  }
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    if (std::abs(hand.actuators[a] - targets.actuators[a]) <= kActuatorTolerance) continue;
    done.add(Intervention::actuator_mismatch);
    break;
  }
  return hand;
}

ArmJoints within_limits(const ArmJoints& targets, Interventions& done) {
  ArmJoints arm = targets;
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    arm[j] = std::clamp(arm[j], radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg));
  }
  if (arm != targets) done.add(Intervention::arm_limit);
  return arm;
}

double target_of(const ShadowActuatorInfo& info, const std::array<double, kShadowJointCount>& joints) {
  return joints[info.joint] + (info.coupled_joint ? joints[*info.coupled_joint] : 0);
}

}  // namespace

bool flag_changes(ShadowHandTargets& hand, const std::array<double, kShadowJointCount>& wanted) {
  for (int j = 0; j < kShadowJointCount; ++j) hand.joint_clamped[j] |= hand.joints[j] != wanted[j];
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
    hand.actuator_clamped[a] |= target_of(info, hand.joints) != target_of(info, wanted);
  }
  return hand.joints != wanted;
}

std::optional<Intervention> refusal(const RobotTargets& targets) {
  const Eigen::Matrix3d R = targets.T_base_hand.linear();
  const bool finite = all_finite(targets.hand.joints) && all_finite(targets.hand.actuators) && R.allFinite() &&
                      targets.T_base_hand.translation().allFinite() && (!targets.arm || all_finite(*targets.arm));
  if (!finite) return Intervention::not_finite;
  if (!(R.isUnitary(kRotationTolerance) && R.determinant() > 0)) return Intervention::not_rigid;
  return std::nullopt;
}

Eigen::Vector3d place_in_workspace(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part) {
  Eigen::Vector3d lowest = limits.workspace_min, highest = limits.workspace_max;
  if (part == GuardedPart::robot) {
    const Fingertips from_origin = targets.T_base_hand.linear() * shadow_fingertips(targets.hand.joints);
    lowest -= from_origin.rowwise().minCoeff().cwiseMin(0);
    highest -= from_origin.rowwise().maxCoeff().cwiseMax(0);
  }
  return targets.T_base_hand.translation().cwiseMax(lowest).cwiseMin(highest);
}

RobotTargets within_limits(const RobotTargets& targets, const CommandLimits& limits, GuardedPart part,
                           Interventions& done) {
  RobotTargets result = targets;
  result.hand = within_limits(targets.hand, limits.coupling, done);
  if (targets.arm) result.arm = within_limits(*targets.arm, done);
  const Eigen::Vector3d place = place_in_workspace(result, limits, part);
  if (place != targets.T_base_hand.translation()) done.add(Intervention::workspace);
  result.T_base_hand.translation() = place;
  return result;
}

}  // namespace glovebench
