#include "core/robot/shadow_kinematics.h"

#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/hand/hand_model.h"
#include "core/robot/fingertip_mapping.h"
#include "core/robot/test_fingertips.h"

namespace glovebench {
namespace {

using Joints = std::array<double, kShadowJointCount>;

constexpr double kKinematicsRounding = 1e-12;  // of sums of lengths under 1 m

const Skeleton& skeleton() {
  static const Skeleton skeleton = HandModel::load(build_paths::hand_mesh()).skeleton();
  return skeleton;
}

/// Of the model's palm frame, which has its origin at WRJ1, in mm.
Eigen::Vector3d in_palm_mm(const Joints& joints, int finger) {
  return 1000 * (shadow_T_hand_palm().inverse() * shadow_fingertips(joints).col(finger));
}

TEST(ShadowKinematics, StraightFingersByHand) {
  const Joints zero{};
  const double thumb = 97.5 / std::sqrt(2);
  EXPECT_TRUE(in_palm_mm(zero, 0).isApprox(Eigen::Vector3d(34 + thumb, -8.5, 29 + thumb), kKinematicsRounding));
  EXPECT_TRUE(in_palm_mm(zero, 1).isApprox(Eigen::Vector3d(33, 0, 191), kKinematicsRounding));
  EXPECT_TRUE(in_palm_mm(zero, 2).isApprox(Eigen::Vector3d(11, 0, 195), kKinematicsRounding));
  EXPECT_TRUE(in_palm_mm(zero, 3).isApprox(Eigen::Vector3d(-11, 0, 191), kKinematicsRounding));
  EXPECT_TRUE(in_palm_mm(zero, 4).isApprox(Eigen::Vector3d(-33, 0, 182.5), kKinematicsRounding));
  // In the hand frame the fingers point to -z, the thumb's side is -x, and the origin is midway to the middle
  // knuckle.
  EXPECT_TRUE(shadow_fingertips(zero).col(2).isApprox(Eigen::Vector3d(-0.0055, 0, -0.1455), kKinematicsRounding));
}

TEST(ShadowKinematics, BentFingersByHand) {
  Joints joints{};
  joints[kFFJ3] = joints[kFFJ2] = radians_from_degrees(90);
  joints[kTHJ4] = radians_from_degrees(70);
  joints[kLFJ4] = radians_from_degrees(20);
  // The first segment to the palm (-y), the others back to the wrist.
  EXPECT_TRUE(in_palm_mm(joints, 1).isApprox(Eigen::Vector3d(33, -45, 95 - 51), kKinematicsRounding));
  const double out = 97.5 * std::cos(radians_from_degrees(70)) / std::sqrt(2),
               down = 97.5 * std::sin(radians_from_degrees(70));
  EXPECT_TRUE(
      in_palm_mm(joints, 0).isApprox(Eigen::Vector3d(34 + out, -8.5 - down, 29 + out), kKinematicsRounding));
  EXPECT_TRUE(in_palm_mm(joints, 4).isApprox(Eigen::Vector3d(-33 + 96 * std::sin(radians_from_degrees(20)), 0,
                                                             86.5 + 96 * std::cos(radians_from_degrees(20))),
                                             kKinematicsRounding));
}

TEST(ShadowKinematics, TheWristCarriesTheHand) {
  Joints joints{};
  EXPECT_TRUE(
      (shadow_T_wrist_hand(joints) * shadow_fingertips(joints).col(2)).isApprox(Eigen::Vector3d(0.011, 0, 0.229)));
  joints[kWRJ1] = radians_from_degrees(28);
  joints[kWRJ2] = radians_from_degrees(10);
  const Eigen::Vector3d tip = shadow_T_wrist_hand(joints) * shadow_fingertips(joints).col(2);
  EXPECT_LT(tip.y(), -0.08) << "bent to the palm";
  EXPECT_GT(tip.x(), 0.03) << "turned to the thumb";
}

Joints random_joints(RandomStream& random) {
  Joints joints;
  for (int j = 0; j < kShadowJointCount; ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    joints[j] = radians_from_degrees(random.uniform(info.min_deg, info.max_deg));
  }
  return joints;
}

TEST(ShadowKinematics, AgreesWithAnotherComputation) {
  RandomStream random(1, "shadow", 0, "fingertips");
  for (int trial = 0; trial < 1000; ++trial) {
    const Joints joints = random_joints(random);
    const Fingertips tips = shadow_fingertips(joints);
    EXPECT_LT((tips - TestFingertips(joints).in_hand()).norm(), 1e-9);
    EXPECT_LT((shadow_T_wrist_hand(joints) * tips - TestFingertips(joints).in_forearm()).norm(), 1e-9);
  }
}

TEST(ShadowKinematics, NoFingertipIsOutOfReach) {
  // Joints at their limits, and stretched fingers: a random posture gets nowhere near.
  RandomStream random(1, "shadow", 0, "reach");
  double from_origin = 0, from_wrist = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    Joints joints{};
    for (int j = 0; j < kShadowJointCount; ++j) {
      const ShadowJointInfo& info = shadow_joint_infos()[j];
      const double u = random.uniform(-1, 2);  // a third of them at each limit, if they are not straight
      joints[j] = random.uniform() < 0.5
                      ? 0
                      : radians_from_degrees(std::clamp(u * (info.max_deg - info.min_deg) + info.min_deg,
                                                        info.min_deg, info.max_deg));
    }
    const Fingertips tips = shadow_fingertips(joints);
    from_origin = std::max(from_origin, tips.colwise().norm().maxCoeff());
    from_wrist = std::max(from_wrist, (shadow_T_wrist_hand(joints) * tips).colwise().norm().maxCoeff());
  }
  EXPECT_LT(from_origin, kShadowHandReach);
  EXPECT_GT(from_origin, 0.98 * kShadowHandReach);
  EXPECT_LT(from_wrist, kShadowWristReach);
  EXPECT_GT(from_wrist, 0.98 * kShadowWristReach);
}

TEST(ShadowKinematics, JacobianIsTheSlopeOfTheFingertips) {
  RandomStream random(1, "shadow", 0, "jacobian");
  for (int trial = 0; trial < 20; ++trial) {
    const Joints joints = random_joints(random);
    const FingertipJacobian J = shadow_fingertip_jacobian(joints);
    for (int j = 0; j < kShadowJointCount; ++j) {
      constexpr double kStep = 1e-6;
      Joints more = joints, less = joints;
      more[j] += kStep;
      less[j] -= kStep;
      const Fingertips slope = (shadow_fingertips(more) - shadow_fingertips(less)) / (2 * kStep);
      for (int f = 0; f < 5; ++f)
        EXPECT_LT((slope.col(f) - J.block<3, 1>(3 * f, j)).norm(), 1e-8) << shadow_joint_infos()[j].name;
    }
  }
}

TEST(ShadowKinematics, EveryAngleMovesTheRobotAsItMovesTheHand) {
  // From a half-closed hand: where the human fingertip goes when an angle grows, the robot's goes as well.
  Posture posture = Posture::Constant(0.4);
  posture[kWristFlexion] = posture[kWristAbduction] = 0;
  for (const int a : {kIndexMcpAbduction, kMiddleMcpAbduction, kRingMcpAbduction, kLittleMcpAbduction})
    posture[a] = 0;
  for (int a = kThumbCmcAbduction; a < kAngleCount; ++a) {
    const int finger = a < kIndexMcpAbduction ? 0 : 1 + (a - kIndexMcpAbduction) / 4;
    Posture more = posture;
    more[a] += 0.05;
    // A last joint that bends more than the one before it pulls that one along.
    const Eigen::Vector3d human =
        (human_fingertips(skeleton(), more) - human_fingertips(skeleton(), posture)).col(finger);
    const Eigen::Vector3d robot =
        (shadow_fingertips(map_to_shadow_hand(more).joints) - shadow_fingertips(map_to_shadow_hand(posture).joints))
            .col(finger);
    EXPECT_GT(human.normalized().dot(robot.normalized()), 0.5) << angle_infos()[a].name;
  }
}

}  // namespace
}  // namespace glovebench
