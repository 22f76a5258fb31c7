#include "core/robot/command_guard.h"

#include <gmock/gmock.h>

#include <limits>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/robot/robot_command.h"
#include "core/robot/test_commands.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

using enum Intervention;
using testing::HasSubstr;

constexpr int64_t kFrame_us = 66'667;
constexpr double kFrame = 66'667e-6;  // s
constexpr double kRounding = 1e-12;   // of sums and differences of numbers around 1

double joint(const std::optional<RobotCommand>& command, ShadowJoint j) { return command->targets->hand.joints[j]; }

/// Everything that a receiver sees, to the last bit.
bool are_identical(const RobotCommand& a, const RobotCommand& b) {
  const auto same = [](const RobotTargets& x, const RobotTargets& y) {
    return x.hand.joints == y.hand.joints && x.hand.actuators == y.hand.actuators &&
           x.hand.joint_clamped == y.hand.joint_clamped && x.hand.actuator_clamped == y.hand.actuator_clamped &&
           x.T_base_hand.matrix() == y.T_base_hand.matrix() && x.arm == y.arm;
  };
  return a.frame_timestamp_us == b.frame_timestamp_us && a.timestamp_us == b.timestamp_us && a.status == b.status &&
         a.hold == b.hold && a.state == b.state && a.interventions == b.interventions &&
         a.targets.has_value() == b.targets.has_value() && (!a.targets || same(*a.targets, *b.targets));
}

/// A movement within all limits at 15 Hz: every joint, hand and arm go to and fro, and wait where a frame is lost.
std::vector<RobotCommand> legal_stream(uint64_t seed) {
  RandomStream random(seed, "guard", 0, "legal");
  std::array<double, kShadowJointCount> phase;
  for (double& p : phase) p = random.uniform(0, 6.28);
  RobotCommander commander(default_T_base_camera());
  std::vector<RobotCommand> stream;
  std::optional<ArmJoints> arm;
  int moved = 0;  // frames
  for (int i = 0; i < 200; ++i) {
    TrackResult result;
    result.timestamp_us = (i + 1) * kFrame_us;
    if (random.uniform() < 0.9) {
      result.status = TrackStatus::tracked;
      arm = ArmJoints{0.001 * moved, 0.5, 0, 1, 0, 0.3 * std::sin(0.05 * moved), 0};
      ++moved;
    }
    for (int a = 0; a < kAngleCount; ++a) result.posture[a] = 0.15 + 0.14 * std::sin(phase[a] + 0.05 * moved);
    result.T_camera_hand.translation() =
        Eigen::Vector3d(0.1 * std::sin(0.05 * moved), 0.05 * std::cos(0.04 * moved), 0.7);
    result.T_camera_hand.linear() =
        Eigen::AngleAxisd(0.02 * moved, Eigen::Vector3d(1, phase[0], 2).normalized()).toRotationMatrix();
    stream.push_back(commander.command(result));
    if (stream.back().targets) stream.back().targets->arm = arm;
  }
  return stream;
}

TEST(CommandGuard, ALegalStreamPassesBitForBit) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    CommandGuard guard;
    int held = 0;
    for (RobotCommand command : legal_stream(seed)) {
      const std::optional<RobotCommand> sent = guard.guard(command);
      ASSERT_TRUE(sent);
      // That a lost frame is held is counted; with this said, nothing differs.
      if (command.hold && command.targets) command.interventions.add(Intervention::hold), ++held;
      ASSERT_TRUE(are_identical(*sent, command)) << to_json_line(*sent) << "\n" << to_json_line(command);
    }
    EXPECT_GT(held, 5);
    EXPECT_EQ(guard.interventions()[Intervention::hold], held);
  }
}

TEST(CommandGuard, AJumpBecomesASlope) {
  CommandGuard guard;
  guard.guard(good_command(kFrame_us));
  RobotCommand jump = good_command(2 * kFrame_us);
  set_joint(*jump.targets, kFFJ3, 1.5);
  const std::optional<RobotCommand> sent = guard.guard(jump);
  const double way = CommandLimits().hand_joint_speed * kFrame;
  EXPECT_NEAR(joint(sent, kFFJ3), way, kRounding);
  EXPECT_TRUE(sent->targets->hand.joint_clamped[kFFJ3]);
  EXPECT_EQ(sent->interventions[joint_speed], 1);
  EXPECT_EQ(guard.interventions()[joint_speed], 1);
  EXPECT_EQ(guard.interventions()[joint_limit], 0);

  // The sender is silent; ticks go on towards what it asked for until it has been silent for too long.
  int64_t now_us = 2 * kFrame_us;
  double last = joint(sent, kFFJ3);
  for (; now_us < 2 * kFrame_us + 140'000; now_us += 4'000) {
    const auto next = guard.tick(now_us + 4'000);
    EXPECT_EQ(next->state, CommandState::following);
    EXPECT_NEAR(joint(next, kFFJ3) - last, CommandLimits().hand_joint_speed * 0.004, kRounding);
    last = joint(next, kFFJ3);
  }
}

TEST(CommandGuard, ALostHandIsHeldAndThenStopped) {
  CommandGuard guard;
  RobotCommand command = good_command(0);
  set_joint(*command.targets, kMFJ3, 0.4);
  guard.guard(command);
  for (int64_t now_us = 50'000; now_us <= 1'000'000; now_us += 50'000) {
    const auto sent = guard.guard(lost_command(now_us));
    EXPECT_EQ(sent->state, now_us <= 500'000 ? CommandState::holding : CommandState::stopped) << now_us;
    EXPECT_TRUE(sent->hold);
    EXPECT_EQ(joint(sent, kMFJ3), 0.4);
  }
  EXPECT_EQ(guard.interventions()[Intervention::hold], 20);
  EXPECT_EQ(guard.interventions()[stop], 1);

  // Elsewhere when it is seen again: the robot goes there slowly.
  RobotCommand again = good_command(1'050'000);
  set_joint(*again.targets, kMFJ3, 1.4);
  const auto sent = guard.guard(again);
  EXPECT_EQ(sent->state, CommandState::following);
  EXPECT_NEAR(joint(sent, kMFJ3), 0.4 + 2 * 0.05, kRounding);
}

TEST(CommandGuard, ASenderThatDiesIsHeldAndThenStopped) {
  CommandGuard guard;
  RobotCommand command = good_command(7);
  guard.guard(command, 1'000'000);
  EXPECT_EQ(guard.tick(1'150'000)->state, CommandState::following);
  EXPECT_EQ(guard.tick(1'150'001)->state, CommandState::holding);
  EXPECT_EQ(guard.tick(1'500'000)->state, CommandState::holding);
  EXPECT_EQ(guard.tick(1'500'001)->state, CommandState::stopped);
  EXPECT_FALSE(guard.tick(1'500'001)) << "time must go on";
  EXPECT_EQ(guard.tick(1'500'002)->frame_timestamp_us, 7);
}

TEST(CommandGuard, AGapIsNoLicenseToJump) {
  CommandGuard guard;
  guard.guard(good_command(0));
  RobotCommand far = good_command(3'600'000'000);
  set_joint(*far.targets, kRFJ3, 1.5);
  const auto sent = guard.guard(far);
  EXPECT_NEAR(joint(sent, kRFJ3), 2 * CommandLimits().longest_step_s, kRounding);
  EXPECT_EQ(sent->interventions[stop], 1) << "an hour without a command";
}

TEST(CommandGuard, ValuesOutsideTheLimitsAreMovedIntoThem) {
  CommandGuard guard;
  RobotCommand command = good_command(0);
  set_joint(*command.targets, kFFJ4, -1);
  set_joint(*command.targets, kTHJ4, 1e300);
  command.targets->T_base_hand.translation() = Eigen::Vector3d(-1e300, 0, -1);
  command.targets->arm = ArmJoints{4, 0, 0, 0, 0, 0, 0};
  const auto sent = guard.guard(command);
  EXPECT_EQ(joint(sent, kFFJ4), radians_from_degrees(-20));
  EXPECT_EQ(joint(sent, kTHJ4), radians_from_degrees(70));
  // The thumb is 60 mm ahead in x, the middle finger points 145.5 mm down.
  EXPECT_NEAR((sent->targets->T_base_hand.translation() - Eigen::Vector3d(-1.43967, 0, 0.1455)).norm(), 0, 1e-5);
  EXPECT_EQ(sent->targets->arm->at(0), radians_from_degrees(177));
  for (const Intervention kind : {joint_limit, workspace, arm_limit}) EXPECT_EQ(sent->interventions[kind], 1);
}

TEST(CommandGuard, RefusesWhatIsNoCommandAndHolds) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [](Intervention kind, const std::function<void(RobotTargets&)>& spoil) {
    CommandGuard guard;
    guard.guard(good_command(0));
    RobotCommand command = good_command(1'000);
    set_joint(*command.targets, kFFJ3, 0.001);
    spoil(*command.targets);
    const auto sent = guard.guard(command);
    EXPECT_EQ(sent->state, CommandState::holding) << to_string(kind);
    EXPECT_EQ(joint(sent, kFFJ3), 0) << to_string(kind);
    EXPECT_EQ(sent->interventions[kind], 1) << to_string(kind);
  };
  refused(not_finite, [&](RobotTargets& t) { t.hand.joints[kWRJ2] = nan; });
  refused(not_finite, [&](RobotTargets& t) { t.hand.actuators[3] = infinity; });
  refused(not_finite, [&](RobotTargets& t) { t.T_base_hand.translation().z() = -infinity; });
  refused(not_finite, [&](RobotTargets& t) { t.T_base_hand.linear()(1, 2) = nan; });
  refused(not_finite, [&](RobotTargets& t) { t.arm = ArmJoints{0, nan, 0, 0, 0, 0, 0}; });
  refused(not_rigid, [&](RobotTargets& t) { t.T_base_hand.linear() *= 1.001; });
  refused(not_rigid, [&](RobotTargets& t) { t.T_base_hand.linear()(0, 0) = -1; });
  refused(not_rigid, [&](RobotTargets& t) { t.T_base_hand.linear().setZero(); });
}

TEST(CommandGuard, StampsRise) {
  CommandGuard guard;
  guard.guard(good_command(1'000));
  EXPECT_FALSE(guard.guard(good_command(1'000)));
  EXPECT_FALSE(guard.guard(good_command(-5)));
  EXPECT_FALSE(guard.guard(good_command(std::numeric_limits<int64_t>::min())));
  const auto sent = guard.guard(good_command(1'001));
  EXPECT_EQ(sent->interventions[stale], 3) << "those of commands that were not sent are told with the next";
  EXPECT_EQ(guard.interventions()[stale], 3);
}

TEST(CommandGuard, AnOldCommandOfALivingSenderIsDroppedAndANewSenderIsHeard) {
  CommandGuard guard;
  guard.guard(good_command(900), 10'000'000);
  RobotCommand old = good_command(800);
  set_joint(*old.targets, kFFJ3, 0.01);
  EXPECT_EQ(joint(guard.guard(old, 10'010'000), kFFJ3), 0);
  RobotCommand old_frame = good_command(901);
  old_frame.frame_timestamp_us = 800;
  set_joint(*old_frame.targets, kFFJ3, 0.01);
  EXPECT_EQ(joint(guard.guard(old_frame, 10'020'000), kFFJ3), 0);
  EXPECT_EQ(guard.interventions()[stale], 2);
  // Silent for over half a second: it may have been started anew, with a clock of its own.
  EXPECT_EQ(guard.tick(10'600'000)->state, CommandState::stopped);
  const auto sent = guard.guard(old, 10'610'000);
  EXPECT_EQ(sent->state, CommandState::following);
  EXPECT_EQ(joint(sent, kFFJ3), 0.01);
}

TEST(CommandGuard, OneStampFarAheadDoesNotSilenceTheSender) {
  CommandGuard guard;
  guard.guard(good_command(1'000), 0);
  guard.guard(good_command(std::numeric_limits<int64_t>::max()), 10'000);
  std::optional<RobotCommand> sent;
  for (int64_t now_us = 20'000; now_us <= 600'000; now_us += 10'000)
    sent = guard.guard(good_command(now_us), now_us);
  EXPECT_EQ(sent->state, CommandState::following);
  EXPECT_EQ(guard.interventions()[stop], 1) << "a stop between them, but no end";
}

TEST(CommandGuard, SendsNothingButAStopBeforeAFirstCommand) {
  CommandGuard guard;
  const auto sent = guard.tick(5);
  EXPECT_EQ(sent->state, CommandState::stopped);
  EXPECT_FALSE(sent->targets);
  EXPECT_TRUE(sent->interventions.none());
}

TEST(CommandGuard, StartsFromWhereTheRobotStands) {
  CommandGuard guard;
  RobotTargets measured = *good_command(0).targets;
  set_joint(measured, kFFJ3, 1);
  guard.start_from(measured);
  EXPECT_EQ(joint(guard.tick(5), kFFJ3), 1) << "and says where it holds the robot";
  EXPECT_NEAR(joint(guard.guard(good_command(10'005)), kFFJ3), 1 - 2 * 0.01, kRounding);
  measured.hand.joints[kFFJ3] = 2;
  EXPECT_THROW(guard.start_from(measured), Error);
  set_joint(measured, kFFJ3, 1);
  measured.T_base_hand.translation().z() = 0.1;
  EXPECT_THAT(thrown_by([&] { guard.start_from(measured); }),
              HasSubstr("measured state: found outside the limits (workspace)"))
      << "fingertips under the table";
  measured.hand.joints[kFFJ3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(guard.start_from(measured), Error);
}

TEST(CommandGuard, AnArmWithoutATargetStays) {
  CommandGuard guard;
  RobotCommand with = good_command(0);
  with.targets->arm = ArmJoints{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  guard.guard(with);
  EXPECT_EQ(guard.guard(good_command(10'000))->targets->arm, with.targets->arm);
  RobotCommand far = good_command(20'000);
  far.targets->arm = ArmJoints{1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const auto sent = guard.guard(far);
  EXPECT_NEAR(sent->targets->arm->at(0), 0.1 + radians_from_degrees(57) * 0.01, kRounding);
  EXPECT_EQ(sent->interventions[arm_speed], 1);
}

TEST(CommandGuard, NamesAllThatIsWrongWithItsLimits) {
  CommandLimits limits;
  limits.hand_speed = 0;
  limits.arm_speed_share = 1.5;
  limits.stop_after_s = 0.1;
  limits.workspace_min.x() = 5;
  limits.longest_step_s = std::numeric_limits<double>::quiet_NaN();
  limits.fingertip_speed = std::numeric_limits<double>::infinity();
  EXPECT_EQ(limits.problems().size(), 7U) << "the workspace is empty and too small";
  EXPECT_THAT(thrown_by([&] { CommandGuard guard(limits); }),
              testing::AllOf(HasSubstr("hand_speed"), HasSubstr("stop_after_s")));
}

}  // namespace
}  // namespace glovebench
