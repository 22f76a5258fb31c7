#include "core/adapters/kdl/make_arm_solver.h"

#include <gmock/gmock.h>

#include <limits>

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/robot/arm.h"
#include "core/robot/robot_command.h"

namespace glovebench {
namespace {

/// Elbow up, the flange pointing down.
constexpr ArmJoints kLookingDown = {0, 0.5, 0, 1.5, 0, 1.1, 0};

/// Straight down at a place, turned about the vertical.
Eigen::Isometry3d looking_down(double x, double y, double z, double turn = 0) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY());
}

void expect_reached(const ArmJoints& joints, const Eigen::Isometry3d& T_base_flange) {
  const Eigen::Isometry3d found = arm_flange_pose(joints);
  // What the solver promises, as seen from outside.
  EXPECT_LT((found.translation() - T_base_flange.translation()).norm(), 1e-5);
  EXPECT_LT((found.linear() - T_base_flange.linear()).norm(), 3e-5);
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    EXPECT_GE(degrees_from_radians(joints[j]), info.min_deg) << info.name;
    EXPECT_LE(degrees_from_radians(joints[j]), info.max_deg) << info.name;
  }
}

TEST(KdlArmSolver, ReachesAGridBeforeTheArm) {
  for (int x = 0; x <= 7; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = 0; z <= 4; ++z)
        for (const double turn : {-0.8, 0.0, 0.8}) {
          ArmFollower follower(make_arm_solver(kLookingDown), kLookingDown);
          const Eigen::Isometry3d T = looking_down(0.4 + 0.05 * x, 0.1 * y, 0.2 + 0.1 * z, turn);
          ASSERT_TRUE(follower.follow(T)) << T.translation().transpose() << ", turned by " << turn;
          expect_reached(follower.joints(), T);
        }
}

TEST(KdlArmSolver, FindsJointsAgainFromNearby) {
  const std::unique_ptr<ArmSolver> solver = make_arm_solver();
  RandomStream random(1, "arm", 0, "joints");
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    ArmJoints joints, start;
    for (int j = 0; j < kArmJointCount; ++j) {
      const ArmJointInfo& info = arm_joint_infos()[j];
      joints[j] = radians_from_degrees(random.uniform(0.8 * info.min_deg, 0.8 * info.max_deg));
      start[j] = joints[j] + random.uniform(-0.1, 0.1);
    }
    const Eigen::Isometry3d T = arm_flange_pose(joints);
    const std::optional<ArmJoints> again = solver->solve(T, start);
    if (!again) continue;
    expect_reached(*again, T);
    ++found;
  }
  EXPECT_GE(found, 990) << "of 1000; near a stretched arm or wrist it may take another way";
}

TEST(KdlArmSolver, RefusesWhatIsOutOfReach) {
  const std::unique_ptr<ArmSolver> solver = make_arm_solver();
  EXPECT_FALSE(solver->solve(looking_down(1.5, 0, 0.3), kArmAtRest));
  EXPECT_FALSE(solver->solve(looking_down(0, 0, 0.1), kArmAtRest)) << "inside its own base";
  Eigen::Isometry3d nowhere = looking_down(0.5, 0, 0.3);
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver->solve(nowhere, kArmAtRest));
  ArmFollower follower(make_arm_solver(kLookingDown), kLookingDown);
  ASSERT_TRUE(follower.follow(looking_down(0.6, 0, 0.3)));
  const ArmJoints before = follower.joints();
  EXPECT_FALSE(follower.follow(looking_down(1.5, 0, 0.3)));
  EXPECT_FALSE(follower.follow(nowhere));
  EXPECT_EQ(follower.joints(), before) << "it keeps what it had";
}

TEST(KdlArmSolver, FollowsAPathWithoutJumps) {
  ArmFollower follower(make_arm_solver(kLookingDown), kLookingDown);
  ASSERT_TRUE(follower.follow(looking_down(0.6, 0, 0.4)));
  ArmJoints last = follower.joints();
  for (int i = 1; i <= 3000; ++i) {
    const double t = 0.01 * i;  // 100 Hz
    const Eigen::Isometry3d T = looking_down(0.6 + 0.15 * std::sin(0.9 * t), 0.25 * std::sin(0.7 * t),
                                             0.4 + 0.1 * std::sin(1.1 * t), 0.6 * std::sin(0.5 * t)) *
                                Eigen::AngleAxisd(0.3 * std::sin(0.8 * t), Eigen::Vector3d::UnitX());
    ASSERT_TRUE(follower.follow(T)) << t;
    for (int j = 0; j < kArmJointCount; ++j)
      EXPECT_LE(std::abs(follower.joints()[j] - last[j]),
                radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * 0.01)
          << arm_joint_infos()[j].name << " at " << t;
    last = follower.joints();
  }
}

}  // namespace
}  // namespace glovebench
