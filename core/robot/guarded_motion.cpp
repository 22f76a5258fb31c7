#include "core/robot/guarded_motion.h"

#include "core/base/angles.h"

namespace glovebench {
namespace {

/// A motor's target may differ by what rounding to 1e-6 degrees of two joints and of itself makes, and no more.
constexpr double kActuatorTolerance = 1e-6;  // rad
/// As `RobotCommander` admits it of a transform.
constexpr double kRotationTolerance = 1e-6;

template <typename Range>
bool all_finite(const Range& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

void flag_actuators(ShadowHandTargets& hand, const std::array<bool, kShadowJointCount>& changed) {
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
    hand.actuator_clamped[a] |= changed[info.joint] || (info.coupled_joint && changed[*info.coupled_joint]);
  }
}

void note_changes(ShadowHandTargets& hand, const std::array<double, kShadowJointCount>& wanted, Intervention kind,
                  Interventions& done) {
  std::array<bool, kShadowJointCount> changed{};
  for (int j = 0; j < kShadowJointCount; ++j) {
    changed[j] = hand.joints[j] != wanted[j];
    hand.joint_clamped[j] |= changed[j];
  }
  flag_actuators(hand, changed);
  if (std::ranges::count(changed, true) > 0) done.add(kind);
}

ShadowHandTargets within_limits(const ShadowHandTargets& targets, Interventions& done) {
  ShadowHandTargets hand = targets;
  for (int j = 0; j < kShadowJointCount; ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    hand.joints[j] =
        std::clamp(hand.joints[j], radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg));
  }
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    double& proximal = hand.joints[info.joint];
    double& distal = hand.joints[*info.coupled_joint];
    if (distal > proximal) proximal = distal = (proximal + distal) / 2;
  }
  note_changes(hand, targets.joints, Intervention::joint_limit, done);
  make_actuators(hand);
  bool matches = true;
  for (int a = 0; a < kShadowActuatorCount; ++a)
    matches &= std::abs(hand.actuators[a] - targets.actuators[a]) <= kActuatorTolerance;
  const bool joints_kept = hand.joints == targets.joints;
  if (joints_kept && !matches) done.add(Intervention::actuator_mismatch);
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

/// Keeps the order of two values: what was not above the other stays so if both may move as far.
double moved(double from, double to, double farthest) {
  return std::clamp(to, from - farthest, from + farthest);
}

ShadowHandTargets moved_towards(const ShadowHandTargets& from, const ShadowHandTargets& to, double farthest,
                                Interventions& done) {
  ShadowHandTargets hand = to;
  for (int j = 0; j < kShadowJointCount; ++j) hand.joints[j] = moved(from.joints[j], to.joints[j], farthest);
  note_changes(hand, to.joints, Intervention::joint_speed, done);
  make_actuators(hand);
  return hand;
}

ArmJoints moved_towards(const ArmJoints& from, const ArmJoints& to, double seconds, double share,
                        Interventions& done) {
  ArmJoints arm;
  for (int j = 0; j < kArmJointCount; ++j)
    arm[j] = moved(from[j], to[j], share * radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * seconds);
  if (arm != to) done.add(Intervention::arm_speed);
  return arm;
}

Eigen::Vector3d moved_towards(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double farthest,
                              const CommandLimits& limits, Interventions& done) {
  const double distance = (to - from).norm();
  if (distance <= farthest) return to;
  done.add(Intervention::hand_speed);
  const Eigen::Vector3d p = from + (to - from) * (farthest / distance);
  return p.cwiseMax(limits.workspace_min).cwiseMin(limits.workspace_max);
}

Eigen::Matrix3d turned_towards(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to, double farthest,
                               Interventions& done) {
  const Eigen::Quaterniond q_from = Eigen::Quaterniond(from).normalized(),
                           q_to = Eigen::Quaterniond(to).normalized();
  const double angle = q_from.angularDistance(q_to);
  if (angle <= farthest) return to;
  done.add(Intervention::hand_turn_speed);
  return q_from.slerp(farthest / angle, q_to).normalized().toRotationMatrix();
}

}  // namespace

void make_actuators(ShadowHandTargets& hand) {
  for (int a = 0; a < kShadowActuatorCount; ++a) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
    hand.actuators[a] = hand.joints[info.joint];
    if (info.coupled_joint) hand.actuators[a] += hand.joints[*info.coupled_joint];
  }
}

std::optional<Intervention> refusal(const RobotTargets& targets) {
  const Eigen::Matrix3d R = targets.T_base_hand.linear();
  const bool finite = all_finite(targets.hand.joints) && all_finite(targets.hand.actuators) && R.allFinite() &&
                      targets.T_base_hand.translation().allFinite() && (!targets.arm || all_finite(*targets.arm));
  if (!finite) return Intervention::not_finite;
  if (!(R.isUnitary(kRotationTolerance) && R.determinant() > 0)) return Intervention::not_rigid;
  return std::nullopt;
}

RobotTargets within_limits(const RobotTargets& targets, const CommandLimits& limits, Interventions& done) {
  RobotTargets result = targets;
  result.hand = within_limits(targets.hand, done);
  const Eigen::Vector3d p = targets.T_base_hand.translation();
  const Eigen::Vector3d inside = p.cwiseMax(limits.workspace_min).cwiseMin(limits.workspace_max);
  if (inside != p) done.add(Intervention::workspace);
  result.T_base_hand.translation() = inside;
  if (targets.arm) result.arm = within_limits(*targets.arm, done);
  return result;
}

RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, Interventions& done) {
  RobotTargets result = to;
  result.hand = moved_towards(from.hand, to.hand, limits.hand_joint_speed * seconds, done);
  result.T_base_hand.translation() = moved_towards(from.T_base_hand.translation(), to.T_base_hand.translation(),
                                                   limits.hand_speed * seconds, limits, done);
  result.T_base_hand.linear() =
      turned_towards(from.T_base_hand.linear(), to.T_base_hand.linear(), limits.hand_turn_speed * seconds, done);
  if (from.arm && to.arm) result.arm = moved_towards(*from.arm, *to.arm, seconds, limits.arm_speed_share, done);
  if (!to.arm) result.arm = from.arm;
  return result;
}

}  // namespace glovebench
