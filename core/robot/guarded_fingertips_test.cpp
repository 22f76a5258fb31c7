// What the guard does about fingertips, and about J1 and J2, which hang on one motor.
#include <gmock/gmock.h>

#include <numbers>

#include "core/base/error.h"
#include "core/robot/command_guard.h"
#include "core/robot/test_commands.h"
#include "core/robot/test_fingertips.h"

namespace glovebench {
namespace {

using enum Intervention;

constexpr int64_t kFingertipFrame_us = 66'667;
constexpr double kFingertipFrame = 66'667e-6;  // s
constexpr double kFingertipRounding = 1e-12;   // of sums and differences of numbers around 1

double joint_of(const std::optional<RobotCommand>& command, ShadowJoint j) {
  return command->targets->hand.joints[j];
}

TEST(GuardedFingertips, HandFingersAndArmAreSlowedDownByOneFactor) {
  CommandGuard guard;
  RobotCommand start = good_command(kFingertipFrame_us);
  start.targets->arm = ArmJoints{};
  guard.guard(start);
  RobotCommand jump = good_command(2 * kFingertipFrame_us);
  set_joint(*jump.targets, kFFJ3, 1.5);
  set_joint(*jump.targets, kTHJ4, 0.5);
  jump.targets->T_base_hand.translation().x() -= 1;
  jump.targets->T_base_hand.linear() = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  jump.targets->arm = ArmJoints{0.4, 0, 0, 0.3, 0, 0, 0};
  const std::optional<RobotCommand> sent = guard.guard(jump);
  const double share = CommandLimits().hand_speed * kFingertipFrame;  // of 1 m: nothing else is as slow
  EXPECT_NEAR(0.5 - sent->targets->T_base_hand.translation().x(), share, kFingertipRounding);
  EXPECT_NEAR(Eigen::AngleAxisd(sent->targets->T_base_hand.linear()).angle(), share, 1e-9);
  EXPECT_NEAR(joint_of(sent, kFFJ3), 1.5 * share, kFingertipRounding);
  EXPECT_NEAR(joint_of(sent, kTHJ4), 0.5 * share, kFingertipRounding);
  EXPECT_NEAR(sent->targets->arm->at(0), 0.4 * share, kFingertipRounding);
  EXPECT_NEAR(sent->targets->arm->at(3), 0.3 * share, kFingertipRounding);
  for (const Intervention kind : {joint_speed, hand_speed, hand_turn_speed, fingertip_speed, arm_speed})
    EXPECT_EQ(sent->interventions[kind], 1) << to_string(kind);
}

TEST(GuardedFingertips, AFingertipKeepsASpeedOfItsOwn) {
  // The hand turns about its x axis, its fingers bend the same way and the hand goes there, all of them by less
  // than they may: together the fingertips would be too fast.
  CommandGuard guard;
  guard.guard(good_command(0));
  RobotCommand fast = good_command(50'000);
  fast.targets->T_base_hand.translation().y() -= 0.24 * 0.05;
  fast.targets->T_base_hand.linear() = Eigen::AngleAxisd(-1.4 * 0.05, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (const ShadowJoint j : {kFFJ3, kFFJ2, kMFJ3, kMFJ2}) set_joint(*fast.targets, j, 1.9 * 0.05);
  const auto sent = guard.guard(fast);
  const auto tip = [](const RobotTargets& targets) -> Eigen::Vector3d {
    return targets.T_base_hand * Eigen::Vector3d(TestFingertips(targets.hand.joints).in_hand().col(2));
  };
  const double wish = (tip(*fast.targets) - tip(*good_command(0).targets)).norm(),
               way = (tip(*sent->targets) - tip(*good_command(0).targets)).norm();
  EXPECT_GT(wish, 0.6 * 0.05);
  EXPECT_LE(way, 0.5 * 0.05 * (1 + 1e-9));
  EXPECT_GE(way, 0.5 * 0.05 * 0.998) << "and not slower than it may";
  EXPECT_EQ(sent->interventions[fingertip_speed], 1);
  for (const Intervention kind : {joint_speed, hand_speed, hand_turn_speed})
    EXPECT_EQ(sent->interventions[kind], 0);
  EXPECT_NEAR(joint_of(sent, kFFJ3) / joint_of(fast, kFFJ3),
              sent->targets->T_base_hand.translation().y() / fast.targets->T_base_hand.translation().y(), 1e-9)
      << "one factor";
}

TEST(GuardedFingertips, FingertipsStayInTheWorkspace) {
  const CommandLimits limits;
  const auto lowest_tip = [](const RobotTargets& t) {
    const Eigen::Matrix3d R = t.T_base_hand.linear();
    return (R * TestFingertips(t.hand.joints).in_hand()).row(2).minCoeff() + t.T_base_hand.translation().z();
  };
  CommandGuard guard;
  // 0.1 m above the table with fingers that point down, 0.145 m long.
  RobotCommand command = good_command(0);
  command.targets->T_base_hand.translation().z() = 0.1;
  auto sent = guard.guard(command);
  EXPECT_NEAR(sent->targets->T_base_hand.translation().z(), 0.1455, 1e-9) << "lifted";
  EXPECT_NEAR(lowest_tip(*sent->targets), 0, 1e-9);
  EXPECT_EQ(sent->interventions[workspace], 1);
  // Level, it may be there. On its way down and up again no fingertip gets through the table.
  const auto reaches = [&](RobotCommand goal) {
    for (int i = 0; i < 400; ++i) {
      goal.timestamp_us = goal.frame_timestamp_us = sent->timestamp_us + 10'000;
      sent = guard.guard(goal);
      EXPECT_GE(lowest_tip(*sent->targets), -1e-9) << i;
      if (sent->targets->T_base_hand.isApprox(goal.targets->T_base_hand, 1e-12)) return i > 10;
    }
    return false;
  };
  RobotCommand level = good_command(0);
  level.targets->T_base_hand.translation().z() = 0.02;
  level.targets->T_base_hand.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(reaches(level));
  RobotCommand over = good_command(0);  // the other way round, through fingers that point down
  over.targets->T_base_hand.translation().z() = 0.02;
  over.targets->T_base_hand.linear() =
      Eigen::AngleAxisd(-std::numbers::pi / 2 + 0.01, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(reaches(over));
}

TEST(GuardedFingertips, MotorsFollowTheirJointsAndJointsTheirMotors) {
  for (const ShadowCoupling model : {ShadowCoupling::series, ShadowCoupling::even}) {
    CommandLimits limits;
    limits.coupling = model;
    CommandGuard guard(limits);
    RobotCommand command = good_command(0);
    set_joint(*command.targets, kLFJ2, 0.2);
    command.targets->hand.joints[kLFJ1] = 0.6;  // above J2, and without its motor
    const bool even = model == ShadowCoupling::even;
    auto sent = guard.guard(command);
    EXPECT_NEAR(joint_of(sent, kLFJ1), even ? 0.4 : 0, kFingertipRounding);
    EXPECT_NEAR(joint_of(sent, kLFJ2), even ? 0.4 : 0.8, kFingertipRounding);
    EXPECT_NEAR(sent->targets->hand.actuators[9], 0.8, kFingertipRounding) << shadow_actuator_infos()[9].name;
    EXPECT_EQ(sent->interventions[joint_limit], 1);
    EXPECT_EQ(sent->interventions[coupling], 0);
    command = good_command(1'000'000);
    set_joint(*command.targets, kLFJ2, 0.7);
    set_joint(*command.targets, kLFJ1, 0.1);  // under J2, but not where one motor can take both
    sent = CommandGuard(limits).guard(command);
    EXPECT_NEAR(joint_of(sent, kLFJ1), even ? 0.4 : 0, kFingertipRounding);
    EXPECT_NEAR(joint_of(sent, kLFJ2), even ? 0.4 : 0.8, kFingertipRounding);
    EXPECT_EQ(sent->interventions[joint_limit], 0);
    EXPECT_EQ(sent->interventions[coupling], 1);
    EXPECT_TRUE(sent->targets->hand.joint_clamped[kLFJ1]);
    EXPECT_FALSE(sent->targets->hand.actuator_clamped[9]) << "the motor does what was asked of it";
  }
  CommandGuard guard;
  guard.guard(good_command(0));
  RobotCommand command = good_command(0);
  command = good_command(1'000);
  command.targets->hand.actuators[0] = 3;
  const auto other = guard.guard(command);
  EXPECT_EQ(other->targets->hand.actuators[0], 0);
  EXPECT_EQ(other->interventions[actuator_mismatch], 1);
}

TEST(GuardedFingertips, AFingerThatTouchedSomethingComesToObeyItsCoupling) {
  for (const ShadowCoupling model : {ShadowCoupling::series, ShadowCoupling::even}) {
    CommandLimits limits;
    limits.coupling = model;
    CommandGuard guard(limits);
    RobotTargets measured = *good_command(0).targets;
    set_joint(measured, kFFJ2, 0.9);
    set_joint(measured, kFFJ1, 0.3);
    guard.start_from(measured);
    EXPECT_EQ(joint_of(guard.tick(0), kFFJ1), 0.3);
    RobotCommand goal = good_command(0);
    set_joint(*goal.targets, kFFJ2, 0.6);
    set_joint(*goal.targets, kFFJ1, 0.6);
    const CoupledJoints end = split_motor(1.2, model);
    double off = std::abs(0.3 - end.distal);
    std::optional<RobotCommand> sent;
    for (int i = 1; i <= 60 && off > kFingertipRounding; ++i) {
      goal.timestamp_us = goal.frame_timestamp_us = 10'000 * i;
      sent = guard.guard(goal);
      EXPECT_NEAR(sent->targets->hand.actuators[0], 1.2, kFingertipRounding) << "the motor stays";
      EXPECT_LE(joint_of(sent, kFFJ1), joint_of(sent, kFFJ2));
      const double before = std::exchange(off, std::abs(joint_of(sent, kFFJ1) - end.distal));
      EXPECT_NEAR(off, std::max(0.0, before - 0.02), kFingertipRounding) << "as fast as a joint may";
    }
    EXPECT_LE(off, kFingertipRounding);
    measured.hand.joints[kFFJ1] = 1;
    make_actuators(measured.hand);
    EXPECT_THROW(guard.start_from(measured), Error) << "J1 above J2";
  }
}

TEST(GuardedFingertips, AWorkspaceHasRoomForTheHand) {
  CommandLimits limits;
  limits.workspace_min = {0, 0, 0};
  limits.workspace_max = {0.46, 0.5, 0.46};
  EXPECT_NO_THROW(CommandGuard(limits, GuardedPart::arm)) << "twice the reach about the wrist";
  limits.workspace_max.z() = 0.4;
  EXPECT_NO_THROW(CommandGuard(limits, GuardedPart::robot));
  EXPECT_THROW(CommandGuard(limits, GuardedPart::arm), Error);
  limits.workspace_max.z() = 0.29;
  EXPECT_THROW(CommandGuard(limits, GuardedPart::robot), Error);
}

}  // namespace
}  // namespace glovebench
