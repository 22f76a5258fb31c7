// Servers of hand and arm together.
#include <gmock/gmock.h>

#include "core/adapters/dds/server/robot_server.h"
#include "core/adapters/dds/server/test_messages.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/robot/shadow_kinematics.h"
#include "core/robot/test_fingertips.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

/// Hand and arm in one server. Every tick is checked in the arm's base frame, by kinematics of the fingers that are
/// not the library's.
class RobotServerHandAndArm : public testing::Test {
 protected:
  TestFingertips::Tips tips(const std::vector<double>& positions) const {
    std::array<double, kShadowJointCount> joints;
    std::copy_n(positions.begin(), kShadowJointCount, joints.begin());
    const Eigen::Isometry3d T_base_wrist = wrist_of(positions, T_flange_wrist_);
    return (T_base_wrist.linear() * TestFingertips(joints).in_forearm()).colwise() + T_base_wrist.translation();
  }
  Eigen::Isometry3d hand_of(const std::vector<double>& positions) const {
    std::array<double, kShadowJointCount> joints;
    std::copy_n(positions.begin(), kShadowJointCount, joints.begin());
    return wrist_of(positions, T_flange_wrist_) * shadow_T_wrist_hand(joints);
  }
  RobotState tick() {
    now_us_ += kArmPeriodUs;
    const RobotState state = server_->tick({now_us_, now_us_});
    constexpr double kSeconds = kArmPeriodUs * 1e-6;
    const TestFingertips::Tips before = tips(last_), after = tips(state.position);
    const double way = (after - before).colwise().norm().maxCoeff();
    EXPECT_LE(way, limits_.fingertip_speed * kSeconds + kArmRounding);
    fastest_ = std::max(fastest_, way / kSeconds);
    EXPECT_GE((after.colwise() - limits_.workspace_min).minCoeff(), -1e-4);
    EXPECT_LE((after.colwise() - limits_.workspace_max).maxCoeff(), 1e-4);
    const Eigen::Isometry3d T_before = hand_of(last_), T_after = hand_of(state.position);
    EXPECT_LE((T_after.translation() - T_before.translation()).norm(),
              limits_.hand_speed * kSeconds + kArmRounding);
    EXPECT_LE(Eigen::Quaterniond(T_before.linear()).angularDistance(Eigen::Quaterniond(T_after.linear())),
              limits_.hand_turn_speed * kSeconds + kArmRounding);
    const std::vector<JointMotion> motions = robot_.motions(limits_);
    for (size_t j = 0; j < motions.size(); ++j) {
      EXPECT_LE(std::abs(state.position[j] - last_[j]), motions[j].speed * kSeconds + kArmRounding) << j;
      EXPECT_GE(state.position[j], motions[j].min);
      EXPECT_LE(state.position[j], motions[j].max);
    }
    last_ = state.position;
    return state;
  }
  Receipt fingers(double angle_deg) {
    return send(RobotTopic::fingers, trajectory_message(hand_trajectory_names(), angle_deg, now_us_));
  }
  Receipt wrist(double angle_deg) {
    return send(RobotTopic::wrist, trajectory_message(wrist_trajectory_names(), angle_deg, now_us_));
  }
  Receipt pose(const Eigen::Isometry3d& T_base_wrist) {
    const Eigen::Vector3d p = T_base_wrist.translation();
    const Eigen::Quaterniond q(T_base_wrist.linear());
    ros::PoseStamped message = pose_at(p.x(), p.y(), p.z(), now_us_);
    message.qx = q.x(), message.qy = q.y(), message.qz = q.z(), message.qw = q.w();
    return send(RobotTopic::pose, message);
  }
  Receipt pose(double x, double y, double z) { return pose(Eigen::Translation3d(x, y, z) * T_start_); }
  template <typename Message>
  Receipt send(RobotTopic topic, const Message& message) {
    return server_->receive(topic, message, {kSender, now_us_ * 1000, now_us_});
  }
  /// After that the next messages are accepted.
  void start() {
    server_.emplace(limits_, robot_, StartPlace{last_});
    for (int i = 0; i < 20; ++i) {
      tick();
      fingers(0), wrist(0), pose(0, 0, 0);
    }
    tick();
  }

  CommandLimits limits_;
  SleepingSolver solver_;
  Eigen::Isometry3d T_flange_wrist_ = default_T_flange_wrist();
  ServedRobot robot_{true, MountedArm{&solver_, T_flange_wrist_}};
  std::vector<double> last_ = robot_.at_rest();
  Eigen::Isometry3d T_start_ = wrist_of(last_, T_flange_wrist_);
  std::optional<RobotServer> server_;
  int64_t now_us_ = 1'000'000;
  double fastest_ = 0;  ///< of the fingertips, m/s
};

TEST_F(RobotServerHandAndArm, FingertipsKeepTheirSpeedInTheBaseFrame) {
  solver_.asleep = false;
  start();
  for (int i = 0; i < 300; ++i) {  // to and fro: fingers, wrist and arm all that way
    const bool there = i / 60 % 2 == 0;
    fingers(there ? 80 : 0), wrist(there ? 25 : -25);
    pose(there ? -0.2 : 0, there ? 0.2 : 0, there ? 0.1 : 0);
    tick();  // checks it
  }
  RandomStream random(1, "hand and arm", 0, "goals");
  for (int i = 0; i < 40; ++i) {
    const double bend = 45 + 45 * random.normal(), turn = 20 * random.normal();
    const Eigen::Isometry3d goal = Eigen::Translation3d(0.1 * random.normal(), 0.2 * random.normal(), 0) *
                                   T_start_ * Eigen::AngleAxisd(0.3 * random.normal(), Eigen::Vector3d::UnitX());
    for (int k = 0; k < 15; ++k) {
      fingers(bend), wrist(turn), pose(goal);
      tick();
    }
  }
  EXPECT_GT(fastest_, 0.99 * limits_.fingertip_speed) << "and they use it";
  EXPECT_GT(server_->interventions()[Intervention::fingertip_speed], 100);
}

TEST_F(RobotServerHandAndArm, OneFactorSlowsAllJointsDown) {
  solver_.asleep = false;
  start();
  const Eigen::Vector3d before = hand_of(last_).translation(), way(-0.1, 0.2, 0.05);
  fingers(80), pose(way.x(), way.y(), way.z());
  tick();
  const double share = last_[kFFJ3] / radians_from_degrees(80);
  EXPECT_GT(share, 1e-3);
  EXPECT_LT(share, 0.05);
  const Eigen::Vector3d moved = hand_of(last_).translation() - before;
  EXPECT_LT((moved - share * way).norm(), 1e-3 * share * way.norm()) << "a step along the arm's curve";
}

TEST_F(RobotServerHandAndArm, WhoIsNotCommandedStays) {
  solver_.asleep = false;
  start();
  std::vector<double> at_start = last_;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(fingers(80), Receipt::accepted);
    EXPECT_EQ(wrist(20), Receipt::accepted);
    EXPECT_EQ(tick().state, CommandState::following);
  }
  EXPECT_GT(last_[kFFJ3], 0.4);
  EXPECT_TRUE(std::equal(last_.end() - kArmJointCount, last_.end(), at_start.end() - kArmJointCount)) << "the arm";
  for (int i = 0; i < 50; ++i) tick();
  at_start = last_;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(pose(0, 0.1, 0), Receipt::accepted);
    tick();
  }
  EXPECT_NE(last_.back(), at_start.back());
  EXPECT_TRUE(std::equal(at_start.begin(), at_start.end() - kArmJointCount, last_.begin())) << "the hand";
}

TEST_F(RobotServerHandAndArm, FingersGoOnWhereTheArmReachesNothing) {
  start();
  for (int i = 0; i < 100; ++i) {
    fingers(30), pose(0, 0.1, 0);
    tick();
  }
  EXPECT_NEAR(last_[kFFJ3], radians_from_degrees(30), kArmRounding);
  EXPECT_EQ(server_->interventions()[Intervention::arm_unreachable], 100);
  EXPECT_EQ(wrist_of(last_, T_flange_wrist_).matrix(), T_start_.matrix());
}

TEST_F(RobotServerHandAndArm, NoFingertipLeavesTheWorkspaceHoweverTheHandIsBent) {
  solver_.asleep = false;
  for (int i = 0; i < kShadowJointCount; ++i) last_[i] = 0;
  for (const int j3 : {kFFJ3, kMFJ3, kRFJ3, kLFJ3}) last_[j3] = radians_from_degrees(90);
  const double lowest = tips(last_).row(2).minCoeff(), highest = tips(last_).row(2).maxCoeff();
  last_ = robot_.at_rest();
  // Bent fingers would be out below or above, whichever way they bend.
  const TestFingertips::Tips straight = tips(last_);
  const bool down = straight.row(2).minCoeff() - lowest > highest - straight.row(2).maxCoeff();
  if (down)
    limits_.workspace_min.z() = straight.row(2).minCoeff() - 0.02;
  else
    limits_.workspace_max.z() = straight.row(2).maxCoeff() + 0.02;
  start();
  for (int i = 0; i < 100; ++i) {
    fingers(90);
    tick();  // checks it
  }
  EXPECT_GT(last_[kMFJ3], 0.05);
  EXPECT_LT(last_[kMFJ3], radians_from_degrees(80)) << "held at the face";
  EXPECT_GT(server_->interventions()[Intervention::workspace], 0);
  EXPECT_EQ(wrist_of(last_, T_flange_wrist_).matrix(), T_start_.matrix());
  for (int i = 0; i < 300; ++i) {
    fingers(90), pose(0, 0, 0);
    tick();
  }
  EXPECT_NEAR(last_[kMFJ3], radians_from_degrees(90), 1e-6) << "an arm that may move takes the hand aside";
  EXPECT_GT((wrist_of(last_, T_flange_wrist_).translation() - T_start_.translation()).norm(), 0.005);
}

TEST_F(RobotServerHandAndArm, OneSenderOwnsHandAndArm) {
  start();
  EXPECT_EQ(fingers(10), Receipt::accepted);
  const ros::PoseStamped other = pose_at(0.5, 0, 0.5, now_us_);
  EXPECT_EQ(server_->receive(RobotTopic::pose, other, {kSender + 1, now_us_ * 1000, now_us_}), Receipt::foreign);
}

TEST_F(RobotServerHandAndArm, StartsWithItsFingertipsInTheWorkspace) {
  const Eigen::Vector3d highest = tips(last_).rowwise().maxCoeff();
  limits_.workspace_max.z() = std::max(highest.z(), hand_of(last_).translation().z()) + 1e-3;
  EXPECT_NO_THROW(RobotServer(limits_, robot_, {last_}));
  limits_.workspace_max.z() -= 3e-3;
  EXPECT_THAT(thrown_by([&] {
                RobotServer(limits_, robot_, {last_, "robot.jsonl"});
              }),
              testing::StartsWith("robot.jsonl: hand on the arm: found ("));
}

}  // namespace
}  // namespace glovebench
