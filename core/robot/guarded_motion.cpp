#include "core/robot/guarded_motion.h"

#include "core/base/math.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

/// How far motors may differ from their joints, and J1 and J2 from their model, by rounding to 1e-6 degrees.
constexpr double kActuatorTolerance = 1e-6;  // rad
/// As `RobotCommander` admits it of a transform.
constexpr double kRotationTolerance = 1e-6;

template <typename Range>
bool all_finite(const Range& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Splits J1 and J2 by the coupling. Returns whether any moved by more than rounding.
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

constexpr double kWayTolerance = 1e-10;    // relative, of a way
constexpr double kPrecision = 1e-3;        // of the largest share
constexpr int kMostAttempts = 60;          // at least every other one halves the range
constexpr double kSlightlyOutside = 5e-5;  // m: five times the tolerance of inverse kinematics

/// Ways divided by the farthest that they may be: above 1 is too fast.
struct Excess {
  std::array<double, kCountOf<Intervention>> by_kind{};

  void add(Intervention kind, double way, double farthest) {
    double& excess = by_kind[static_cast<size_t>(kind)];
    if (way > 0) excess = std::max(excess, way / farthest);
  }
  double largest() const { return std::ranges::max(by_kind); }
};

/// Exact at both ends, and never beyond them.
double between(double from, double to, double share) {
  const auto [lowest, highest] = std::minmax(from, to);
  return share < 1 ? std::clamp(from + share * (to - from), lowest, highest) : to;
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to, double share) {
  if (from == to) return to;
  const Eigen::Quaterniond q_from = Eigen::Quaterniond(from).normalized(),
                           q_to = Eigen::Quaterniond(to).normalized();
  return q_from.slerp(share, q_to).normalized().toRotationMatrix();
}

/// The fingertips in the frame of their speed limit: the base's, or for the hand alone the forearm's.
Fingertips guarded_fingertips(const RobotTargets& targets, GuardedPart part) {
  const std::array<double, kShadowJointCount>& joints = targets.hand.joints;
  return (part == GuardedPart::hand ? shadow_T_wrist_hand(joints) : targets.T_base_hand) *
         shadow_fingertips(joints);
}

/// The way from one pair of targets to another.
class Way {
 public:
  /// With `arm`, both ends have its joints, and the hand is where they take it.
  Way(const RobotTargets& from, const RobotTargets& to, double seconds, const CommandLimits& limits,
      GuardedPart part, const MountedArm* arm = nullptr)
      : from_(from), to_(to), seconds_(seconds), limits_(limits), part_(part), arm_(arm) {
    if (part != GuardedPart::arm) fingertips_ = guarded_fingertips(from, part);
    if (arm) farthest_outside_ = std::max(kSlightlyOutside, outside(from));
  }

  RobotTargets at(double share) const {
    RobotTargets targets = to_;
    targets.hand.joints = joints_at(share);
    for (int j = 0; from_.arm && to_.arm && j < kArmJointCount; ++j)
      (*targets.arm)[j] = between((*from_.arm)[j], (*to_.arm)[j], share);
    if (!to_.arm) targets.arm = from_.arm;
    Eigen::Isometry3d& T = targets.T_base_hand;
    if (arm_) {
      T = carried_pose(arm_->T_base_wrist(*targets.arm), targets.hand.joints, part_);
      return targets;
    }
    T.linear() = turned(from_.T_base_hand.linear(), to_.T_base_hand.linear(), share);
    for (int i = 0; i < 3; ++i)
      T.translation()[i] = between(from_.T_base_hand.translation()[i], to_.T_base_hand.translation()[i], share);
    T.translation() = place_in_workspace(targets, limits_, part_);
    return targets;
  }

  /// How far `next` exceeds each limit.
  Excess excess(const RobotTargets& next) const {
    Excess excess;
    const double joint = limits_.hand_joint_speed * seconds_;
    for (int j = 0; j < kShadowJointCount; ++j)
      excess.add(Intervention::joint_speed, std::abs(next.hand.joints[j] - from_.hand.joints[j]), joint);
    for (int j = 0; from_.arm && next.arm && j < kArmJointCount; ++j)
      excess.add(Intervention::arm_speed, std::abs((*next.arm)[j] - (*from_.arm)[j]),
                 limits_.arm_speed_share * radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * seconds_);
    const double way = (next.T_base_hand.translation() - from_.T_base_hand.translation()).norm();
    const double turn = angle_between(from_.T_base_hand.linear(), next.T_base_hand.linear());
    excess.add(Intervention::hand_speed, way, limits_.hand_speed * seconds_);
    excess.add(Intervention::hand_turn_speed, turn, limits_.hand_turn_speed * seconds_);
    excess.add(Intervention::fingertip_speed, fingertip_way(next, way, turn), limits_.fingertip_speed * seconds_);
    if (arm_) excess.add(Intervention::workspace, outside(next), farthest_outside_);
    return excess;
  }

 private:
  /// How far hand or fingertips are outside the workspace, m.
  double outside(const RobotTargets& targets) const {
    return (place_in_workspace(targets, limits_, part_) - targets.T_base_hand.translation()).norm();
  }
  std::array<double, kShadowJointCount> joints_at(double share) const {
    std::array<double, kShadowJointCount> joints;
    for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
      const auto joint_of = [&](const RobotTargets& t) { return t.hand.joints[info.joint]; };
      if (info.coupled_joint) {
        const ShadowJoint distal = *info.coupled_joint;
        const CoupledJoints both =
            glovebench::between({from_.hand.joints[distal], joint_of(from_)},
                                {to_.hand.joints[distal], joint_of(to_)}, share, limits_.coupling);
        joints[info.joint] = both.proximal;
        joints[distal] = both.distal;
      } else {
        joints[info.joint] = between(joint_of(from_), joint_of(to_), share);
      }
    }
    return joints;
  }

  /// The longest way of a fingertip; for an arm alone, of any place that a fingertip may have.
  double fingertip_way(const RobotTargets& next, double way, double turn) const {
    if (part_ == GuardedPart::arm) return way + kShadowWristReach * turn;
    return (guarded_fingertips(next, part_) - fingertips_).colwise().norm().maxCoeff();
  }

  const RobotTargets& from_;
  const RobotTargets& to_;
  double seconds_;
  const CommandLimits& limits_;
  GuardedPart part_;
  const MountedArm* arm_;
  double farthest_outside_ = 0;  ///< m
  Fingertips fingertips_ = Fingertips::Zero();
};

/// The largest share of a way at which nothing is too fast. Ways are nearly proportional to the share, so a secant
/// finds it in a few steps; halving handles the other cases.
double largest_share(const Way& way, double excess_at_end) {
  double share = 1 / excess_at_end, fine = 0, too_large = 1;
  for (int i = 0; i < kMostAttempts; ++i) {
    const double excess = way.excess(way.at(share)).largest();
    if (excess <= 1 + kWayTolerance && excess >= 1 - kPrecision) return share;
    (excess <= 1 + kWayTolerance ? fine : too_large) = share;
    if (fine > 0 && too_large - fine <= kPrecision * fine) break;
    const double secant = share * (1 - kPrecision / 2) / excess;
    const bool is_inside = secant > fine && secant < too_large && i % 2 == 0;
    share = is_inside ? secant : (fine + too_large) / 2;
  }
  return fine;
}

/// Moves along a way until something is too fast.
RobotTargets moved_along(const Way& way, const RobotTargets& from, const RobotTargets& to, Interventions& done) {
  RobotTargets result = to;
  if (!to.arm) result.arm = from.arm;
  const Excess excess = way.excess(result);
  if (excess.largest() <= 1 + kWayTolerance) return result;
  for (const Intervention kind : all_values<Intervention>())
    if (excess.by_kind[static_cast<size_t>(kind)] > 1 + kWayTolerance) done.add(kind);
  const double share = largest_share(way, excess.largest());
  result = share > 0 ? way.at(share) : from;
  result.hand.joint_clamped = to.hand.joint_clamped;
  result.hand.actuator_clamped = to.hand.actuator_clamped;
  flag_changes(result.hand, to.hand.joints);
  make_actuators(result.hand);
  return result;
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

Eigen::Isometry3d carried_pose(const Eigen::Isometry3d& T_base_wrist,
                               const std::array<double, kShadowJointCount>& joints, GuardedPart part) {
  return part == GuardedPart::arm ? T_base_wrist : T_base_wrist * shadow_T_wrist_hand(joints);
}

RobotTargets moved_towards(const RobotTargets& from, const RobotTargets& to, double seconds,
                           const CommandLimits& limits, GuardedPart part, Interventions& done) {
  return moved_along(Way(from, to, seconds, limits, part), from, to, done);
}

RobotTargets moved_by_arm(const MountedArm& arm, const RobotTargets& from, const RobotTargets& to, double seconds,
                          const CommandLimits& limits, GuardedPart part, Interventions& done) {
  RobotTargets next = to;
  Interventions slowed;
  if (!to.arm) {
    next = moved_towards(from, to, seconds, limits, part, slowed);
    const Eigen::Isometry3d T_hand_wrist =
        carried_pose(Eigen::Isometry3d::Identity(), next.hand.joints, part).inverse();
    next.arm = arm.solver->solve(next.T_base_hand * T_hand_wrist * arm.T_flange_wrist.inverse(), *from.arm);
    if (!next.arm) {
      slowed.add(Intervention::arm_unreachable);
      next = to;
      next.arm = from.arm;
    }
  }
  next.T_base_hand = carried_pose(arm.T_base_wrist(*next.arm), next.hand.joints, part);
  next = moved_along(Way(from, next, seconds, limits, part, &arm), from, next, slowed);
  for (const Intervention kind : all_values<Intervention>())
    if (slowed[kind] > 0) done.add(kind);  // each kind once
  return next;
}

}  // namespace glovebench
