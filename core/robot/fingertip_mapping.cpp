#include "core/robot/fingertip_mapping.h"

#include <Eigen/Cholesky>

#include "core/base/math.h"

namespace glovebench {
namespace {

constexpr int kMotors = kShadowActuatorCount;
using Joints = std::array<double, kShadowJointCount>;
using Vector = Eigen::Matrix<double, kMotors, 1>;
using Matrix = Eigen::Matrix<double, kMotors, kMotors>;
using JointsFromMotors = Eigen::Matrix<double, kShadowJointCount, kMotors>;

// Human thumb and finger: closer than the first they count as pinching, farther than the second as apart.
constexpr double kPinched = 0.025, kApart = 0.09;  // m
// A millimetre between the fingertips costs as much as 10 degrees of a joint, or 2 of a finger's spread: bent, a
// finger hardly moves its tip by spreading, and would jump from one limit to the other for little. The table of
// `glovebench list mapping` shows what these lead to.
constexpr double kDistanceScale = 0.002;                   // m
constexpr double kAngleScale = 0.35, kSpreadScale = 0.08;  // rad
constexpr int kMaxMappingIterations = 50;
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

bool moves_wrist(const ShadowActuatorInfo& info) { return info.joint == kWRJ1 || info.joint == kWRJ2; }

/// What the motors may add to their targets of the direct mapping.
struct Motion {
  ShadowHandTargets direct;
  ShadowCoupling coupling;
  Vector lowest = Vector::Zero(), highest = Vector::Zero();
};

Motion make_motion(const ShadowHandTargets& direct, ShadowCoupling coupling) {
  Motion motion{.direct = direct, .coupling = coupling};
  for (int m = 0; m < kMotors; ++m) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[m];
    if (moves_wrist(info)) continue;
    motion.lowest[m] = limit(info.joint, false) - direct.actuators[m];
    motion.highest[m] = limit(info.joint, true) - direct.actuators[m];
    if (info.coupled_joint) motion.highest[m] += limit(*info.coupled_joint, true);
  }
  return motion;
}

/// Within the limits also where rounding would leave them.
Joints joints_at(const Motion& motion, const Vector& motors) {
  Joints joints;
  for (int m = 0; m < kMotors; ++m) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[m];
    const double target = motion.direct.actuators[m] + motors[m];
    if (info.coupled_joint) {
      const CoupledJoints split =
          split_motor(std::clamp(target, 0.0, 2 * limit(info.joint, true)), motion.coupling);
      joints[info.joint] = split.proximal;
      joints[*info.coupled_joint] = split.distal;
    } else {
      joints[info.joint] = std::clamp(target, limit(info.joint, false), limit(info.joint, true));
    }
  }
  return joints;
}

/// How the joints follow small motions of the motors from there.
JointsFromMotors joints_from_motors(const Motion& motion, const Vector& motors) {
  JointsFromMotors slope = JointsFromMotors::Zero();
  for (int m = 0; m < kMotors; ++m) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[m];
    if (moves_wrist(info)) continue;
    const double share =
        info.coupled_joint ? distal_share(motion.direct.actuators[m] + motors[m], motion.coupling) : 0;
    slope(info.joint, m) = 1 - share;
    if (info.coupled_joint) slope(*info.coupled_joint, m) = share;
  }
  return slope;
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
  const Eigen::Matrix<double, 15, kMotors> tips =
      shadow_fingertip_jacobian(joints) * joints_from_motors(motion, motors);
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
  for (int iteration = 0; iteration < kMaxMappingIterations && damping < 1e8; ++iteration) {
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

/// The targets with the joints moved there. A motor that was moved to a limit is flagged, with its joints.
ShadowHandTargets moved(ShadowHandTargets targets, const Joints& joints) {
  const auto before = targets.actuators;
  targets.joints = joints;
  make_actuators(targets);
  for (int m = 0; m < kMotors; ++m) {
    const ShadowActuatorInfo& info = shadow_actuator_infos()[m];
    const double highest = limit(info.joint, true) + (info.coupled_joint ? limit(*info.coupled_joint, true) : 0);
    const double target = targets.actuators[m];
    if (target == before[m] || (target != limit(info.joint, false) && target != highest)) continue;
    targets.actuator_clamped[m] = targets.joint_clamped[info.joint] = true;
    if (info.coupled_joint) targets.joint_clamped[*info.coupled_joint] = true;
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
  const ShadowHandTargets direct = map_to_shadow_hand(posture, coupling_);
  const Goal goal = make_goal(human_fingertips(skeleton_, posture), direct.joints);
  if (std::ranges::all_of(goal.weights, [](double weight) { return weight == 0; })) {
    reset();
    return direct;
  }
  const Motion motion = make_motion(direct, coupling_);
  last_ = fitted(goal, motion, last_);
  return moved(direct, joints_at(motion, last_));
}

}  // namespace glovebench
