#include "core/robot/fingertip_mapping.h"

#include <Eigen/Cholesky>

#include "core/base/angles.h"

namespace glovebench {
namespace {

constexpr int kMotors = kShadowActuatorCount;
using Joints = std::array<double, kShadowJointCount>;
using Vector = Eigen::Matrix<double, kMotors, 1>;
using Matrix = Eigen::Matrix<double, kMotors, kMotors>;

// Human thumb and finger: closer than the first they count as pinching, farther than the second as apart.
constexpr double kPinched = 0.025, kApart = 0.09;  // m
// A millimetre between the fingertips costs as much as 10 degrees of a joint, or 2 of a finger's spread: bent, a
// finger hardly moves its tip by spreading, and would jump from one limit to the other for little. The table of
// `glovebench list mapping` shows what these lead to.
constexpr double kDistanceScale = 0.002;                   // m
constexpr double kAngleScale = 0.35, kSpreadScale = 0.08;  // rad
constexpr int kMaxIterations = 50;
constexpr double kSmallStep = 1e-9;  // rad

/// 1 if pinched, 0 if apart, smooth between.
double closeness(double distance) {
  const double t = std::clamp((kApart - distance) / (kApart - kPinched), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double limit(ShadowJoint joint, bool upper) {
  const ShadowJointInfo& info = shadow_joint_infos()[joint];
  return radians_from_degrees(upper ? info.max_deg : info.min_deg);
}

bool moves_wrist(const ShadowActuatorInfo& info) {
  return info.joint == kWRJ1 || info.joint == kWRJ2;
}

/// How joints follow when the motors leave the direct mapping, and how far they may.
struct Motion {
  Joints direct;
  Eigen::Matrix<double, kShadowJointCount, kMotors> joints_from_motors =
      Eigen::Matrix<double, kShadowJointCount, kMotors>::Zero();
  Vector lowest = Vector::Zero(), highest = Vector::Zero();
};

/// The share of the last joint in the motion of a motor that turns two: its share in the angle, which is at most a
/// half; a half where there is no angle.
double distal_share(double proximal, double distal) {
  constexpr double kNoAngle = 0.01;  // rad
  return (distal + kNoAngle) / (proximal + distal + 2 * kNoAngle);
}

Motion make_motion(const Joints& direct) {
  Motion motion{.direct = direct};
  for (int m = 0; m < kMotors; ++m) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[m];
    if (moves_wrist(info)) continue;
    const double proximal = direct[info.joint];
    const double share = info.coupled_joint ? distal_share(proximal, direct[*info.coupled_joint]) : 0;
    motion.joints_from_motors(info.joint, m) = 1 - share;
    motion.lowest[m] = (limit(info.joint, false) - proximal) / (1 - share);
    motion.highest[m] = (limit(info.joint, true) - proximal) / (1 - share);
    if (!info.coupled_joint) continue;
    motion.joints_from_motors(*info.coupled_joint, m) = share;
    motion.lowest[m] = std::max(motion.lowest[m], -direct[*info.coupled_joint] / share);
  }
  return motion;
}

/// Within the limits also where rounding would leave them.
Joints joints_at(const Motion& motion, const Vector& motors) {
  const Eigen::Matrix<double, kShadowJointCount, 1> moved = motion.joints_from_motors * motors;
  Joints joints;
  for (int j = 0; j < kShadowJointCount; ++j) {
    const auto joint = static_cast<ShadowJoint>(j);
    joints[j] = std::clamp(motion.direct[j] + moved[j], limit(joint, false), limit(joint, true));
  }
  for (const ShadowActuatorInfo& info : shadow_actuator_infos())
    if (info.coupled_joint) joints[*info.coupled_joint] = std::min(joints[*info.coupled_joint], joints[info.joint]);
  return joints;
}

/// The vectors from the four fingertips to the thumb's that the robot shall have, with their weights.
struct Goal {
  Eigen::Matrix<double, 3, 4> thumb_from_finger;
  std::array<double, 4> weights;
};

Eigen::Matrix<double, 3, 4> thumb_from_finger(const Fingertips& tips) {
  return tips.col(0).replicate<1, 4>() - tips.rightCols<4>();
}

Goal make_goal(const Fingertips& human, const Joints& direct) {
  Goal goal{thumb_from_finger(shadow_fingertips(direct)), {}};
  const Eigen::Matrix<double, 3, 4> wanted = thumb_from_finger(human);
  for (int f = 0; f < 4; ++f) {
    const double close = closeness(wanted.col(f).norm());
    // A high power: a finger that is far from pinching shall not follow a thumb that another one needs.
    goal.weights[f] = std::pow(close, 8) / (kDistanceScale * kDistanceScale);
    goal.thumb_from_finger.col(f) += close * (wanted.col(f) - goal.thumb_from_finger.col(f));
  }
  return goal;
}

/// What a step away from the direct mapping costs, by motor.
const Vector& stiffness() {
  static const Vector stiffness = [] {
    Vector result;
    for (int m = 0; m < kMotors; ++m) {
      const ShadowJoint joint = shadow_actuator_infos()[m].joint;
      const bool spreads = joint == kFFJ4 || joint == kMFJ4 || joint == kRFJ4 || joint == kLFJ4;
      result[m] = std::pow(spreads ? kSpreadScale : kAngleScale, -2);
    }
    return result;
  }();
  return stiffness;
}

/// The sum of squares and, for its next step, its linearization.
struct Fit {
  double cost;
  Matrix H;
  Vector gradient;
};
Fit evaluate(const Goal& goal, const Motion& motion, const Vector& motors) {
  const Joints joints = joints_at(motion, motors);
  const Eigen::Matrix<double, 3, 4> off = thumb_from_finger(shadow_fingertips(joints)) - goal.thumb_from_finger;
  const Eigen::Matrix<double, 15, kMotors> tips = shadow_fingertip_jacobian(joints) * motion.joints_from_motors;
  Fit fit{motors.cwiseProduct(stiffness()).dot(motors), stiffness().asDiagonal(), stiffness().cwiseProduct(motors)};
  for (int f = 0; f < 4; ++f) {
    const Eigen::Matrix<double, 3, kMotors> J = tips.topRows<3>() - tips.middleRows<3>(3 * (f + 1));
    fit.cost += goal.weights[f] * off.col(f).squaredNorm();
    fit.H += goal.weights[f] * J.transpose() * J;
    fit.gradient += goal.weights[f] * J.transpose() * off.col(f);
  }
  return fit;
}

/// The step of Levenberg-Marquardt of the motors that are free to make it.
Vector damped_step(Fit fit, double damping, const Motion& motion, const Vector& motors) {
  fit.H.diagonal() *= 1 + damping;
  for (int m = 0; m < kMotors; ++m) {
    const bool at_limit = fit.gradient[m] < 0 ? motors[m] >= motion.highest[m] : motors[m] <= motion.lowest[m];
    if (!at_limit) continue;
    fit.H.row(m).setZero();
    fit.H.col(m).setZero();
    fit.H(m, m) = 1;
    fit.gradient[m] = 0;
  }
  return -fit.H.ldlt().solve(fit.gradient);
}

Vector fitted(const Goal& goal, const Motion& motion, const Vector& start) {
  Vector motors = start.cwiseMax(motion.lowest).cwiseMin(motion.highest);
  Fit fit = evaluate(goal, motion, motors);
  double damping = 1e-4;
  for (int iteration = 0; iteration < kMaxIterations && damping < 1e8; ++iteration) {
    const Vector step = damped_step(fit, damping, motion, motors);
    const Vector next = (motors + step).cwiseMax(motion.lowest).cwiseMin(motion.highest);
    const Fit next_fit = evaluate(goal, motion, next);
    const bool better = next_fit.cost < fit.cost;
    damping *= better ? 0.1 : 10;
    if (!better) continue;
    const double largest = (next - motors).cwiseAbs().maxCoeff();
    motors = next;
    fit = next_fit;
    if (largest < kSmallStep) break;
  }
  return motors;
}

/// The targets with the joints moved there.
ShadowHandTargets moved(ShadowHandTargets targets, const Joints& joints) {
  for (int j = 0; j < kShadowJointCount; ++j) {
    const auto joint = static_cast<ShadowJoint>(j);
    const bool at_limit = joints[j] == limit(joint, false) || joints[j] == limit(joint, true);
    targets.joint_clamped[j] |= at_limit && joints[j] != targets.joints[j];
    targets.joints[j] = joints[j];
  }
  for (int m = 0; m < kMotors; ++m) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[m];
    targets.actuators[m] = joints[info.joint];
    targets.actuator_clamped[m] |= !info.coupled_joint && targets.joint_clamped[info.joint];
    if (info.coupled_joint) targets.actuators[m] += joints[*info.coupled_joint];
  }
  return targets;
}

}  // namespace

Fingertips human_fingertips(const Skeleton& skeleton, const Posture& posture) {
  const JointPoses T_hand_joint = skeleton.pose(posture);
  Fingertips tips;
  for (int f = 0; f < 5; ++f) tips.col(f) = T_hand_joint[fingertip_joints()[f]].translation();
  return tips;
}

ShadowHandTargets FingertipMapping::map(const Posture& posture) {
  const ShadowHandTargets direct = map_to_shadow_hand(posture);
  const Goal goal = make_goal(human_fingertips(skeleton_, posture), direct.joints);
  if (std::ranges::all_of(goal.weights, [](double weight) { return weight == 0; })) {
    reset();
    return direct;
  }
  const Motion motion = make_motion(direct.joints);
  last_ = fitted(goal, motion, last_);
  return moved(direct, joints_at(motion, last_));
}

}  // namespace glovebench
