#include "core/adapters/kdl/make_arm_solver.h"

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_nr_jl.hpp>
#include <kdl/chainiksolvervel_wdls.hpp>

#include <Eigen/Cholesky>

#include "core/base/math.h"

namespace glovebench {
namespace {

constexpr unsigned kMaxIterations = 100;
constexpr double kSolverTolerance = 1e-7;    // m and rad, of KDL's twist
constexpr double kPositionTolerance = 1e-5;  // m
constexpr double kRotationTolerance = 1e-5;  // rad
/// Damping keeps a step finite where the arm is stretched, and slows others down little.
constexpr double kDamping = 0.01;

/// How far the arm drifts back to rest without moving the flange, over a step of that way or turn. Later values are
/// tried where earlier ones give no solution.
constexpr std::array<double, 4> kBackToRest = {0.05, 0.2, 0.4, 0};
constexpr double kStep = 0.02, kTurn = 0.1;  // m, rad

/// Rows: the flange's motion and turning in the base frame, by joint.
using Jacobian = Eigen::Matrix<double, 6, kArmJointCount>;
using JointVector = Eigen::Matrix<double, kArmJointCount, 1>;

Jacobian jacobian(const ArmJoints& joints) {
  const Eigen::Vector3d p_flange = arm_flange_pose(joints).translation();
  Jacobian J;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int j = 0; j < kArmJointCount; ++j) {
    const Eigen::Vector3d axis = T.linear().col(2);
    J.col(j) << axis.cross(p_flange - T.translation()), axis;
    const ArmJointInfo& info = arm_joint_infos()[j];
    T = T * Eigen::AngleAxisd(joints[j], Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(0, 0, info.d_m) *
        Eigen::AngleAxisd(radians_from_degrees(info.alpha_deg), Eigen::Vector3d::UnitX());
  }
  return J;
}

/// Where to solve from. Seven joints reach a pose in many ways, and with the shortest steps joints wander to their
/// limits. So each joint drifts a little to rest, in proportion to the way to the pose.
ArmJoints nearer_to(const ArmJoints& rest, const ArmJoints& joints, double share,
                    const Eigen::Isometry3d& T_base_flange) {
  const Eigen::Isometry3d off = arm_flange_pose(joints).inverse() * T_base_flange;
  const double turn = Eigen::Quaterniond::Identity().angularDistance(Eigen::Quaterniond(off.linear()));
  const double amount = share * std::min(1.0, off.translation().norm() / kStep + turn / kTurn);
  JointVector wish;
  for (int j = 0; j < kArmJointCount; ++j) wish[j] = amount * (rest[j] - joints[j]);
  const Jacobian J = jacobian(joints);
  Eigen::Matrix<double, 6, 6> square = J * J.transpose();
  square.diagonal().array() += kDamping * kDamping;
  const JointVector step = wish - J.transpose() * square.ldlt().solve(J * wish);
  ArmJoints result;
  for (int j = 0; j < kArmJointCount; ++j) result[j] = joints[j] + step[j];
  return result;
}

KDL::Chain make_chain() {
  KDL::Chain chain;
  for (const ArmJointInfo& info : arm_joint_infos())
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ),
                                  KDL::Frame::DH(0, radians_from_degrees(info.alpha_deg), info.d_m, 0)));
  return chain;
}

KDL::JntArray limits(bool upper) {
  KDL::JntArray result(kArmJointCount);
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    result(j) = radians_from_degrees(upper ? info.max_deg : info.min_deg);
  }
  return result;
}

bool is_within_limits(const ArmJoints& joints) {
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    if (!(joints[j] >= radians_from_degrees(info.min_deg) && joints[j] <= radians_from_degrees(info.max_deg)))
      return false;
  }
  return true;
}

bool reaches(const ArmJoints& joints, const Eigen::Isometry3d& T_base_flange) {
  const Eigen::Isometry3d off = arm_flange_pose(joints).inverse() * T_base_flange;
  return off.translation().norm() <= kPositionTolerance &&
         Eigen::Quaterniond::Identity().angularDistance(Eigen::Quaterniond(off.linear())) <= kRotationTolerance;
}

class KdlArmSolver : public ArmSolver {
 public:
  explicit KdlArmSolver(const ArmJoints& rest) : rest_(rest) { velocity_.setLambda(kDamping); }

  std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const override {
    if (!T_base_flange.matrix().allFinite()) return std::nullopt;
    KDL::Frame target;
    for (int row = 0; row < 3; ++row) {
      target.p(row) = T_base_flange.translation()[row];
      for (int column = 0; column < 3; ++column) target.M(row, column) = T_base_flange.linear()(row, column);
    }
    for (const double share : kBackToRest) {
      const ArmJoints joints = solved_from(nearer_to(rest_, start, share, T_base_flange), target);
      if (is_within_limits(joints) && reaches(joints, T_base_flange)) return joints;
    }
    return std::nullopt;
  }

 private:
  /// KDL's result; the caller checks whether it is a solution.
  ArmJoints solved_from(const ArmJoints& start, const KDL::Frame& target) const {
    KDL::JntArray from(kArmJointCount), to(kArmJointCount);
    for (int j = 0; j < kArmJointCount; ++j) from(j) = start[j];
    position_.CartToJnt(from, target, to);
    ArmJoints joints;
    for (int j = 0; j < kArmJointCount; ++j) joints[j] = to(j);
    return joints;
  }

  ArmJoints rest_;
  KDL::Chain chain_ = make_chain();
  // The solvers keep buffers.
  mutable KDL::ChainFkSolverPos_recursive forward_{chain_};
  mutable KDL::ChainIkSolverVel_wdls velocity_{chain_};
  mutable KDL::ChainIkSolverPos_NR_JL position_{chain_,    limits(false),  limits(true),    forward_,
                                                velocity_, kMaxIterations, kSolverTolerance};
};

}  // namespace

std::unique_ptr<ArmSolver> make_arm_solver(const ArmJoints& rest) { return std::make_unique<KdlArmSolver>(rest); }

}  // namespace glovebench
