// A server of the hand.
#include "core/adapters/dds/server/robot_server.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/adapters/dds/server/test_messages.h"
#include "core/base/math.h"
#include "core/robot/test_fingertips.h"

namespace glovebench {
namespace {

using testing::Each;

constexpr int64_t kPeriodUs = 10'000;
constexpr uint64_t kFirst = 11, kSecond = 22;
constexpr int64_t kEpochUs = 1'800'000'000'000'000;
constexpr double kHandRounding = 1e-12;

/// A server and its clock; every state is checked against the limits.
class RobotServerHand : public testing::Test {
 protected:
  Receipt fingers(double angle_deg, int64_t stamp_us, uint64_t sender = kFirst) {
    return receive(RobotTopic::fingers, trajectory_message(hand_trajectory_names(), angle_deg, stamp_us), sender);
  }
  /// The first finger's J3 alone; all others at 0.
  Receipt first_finger(double angle_deg, int64_t stamp_us) {
    ros::JointTrajectory message = trajectory_message(hand_trajectory_names(), 0, stamp_us);
    message.points[0].positions[kFFJ3] = radians_from_degrees(angle_deg);
    return receive(RobotTopic::fingers, message);
  }
  Receipt wrist(double angle_deg, int64_t stamp_us, uint64_t sender = kFirst) {
    return receive(RobotTopic::wrist, trajectory_message(wrist_trajectory_names(), angle_deg, stamp_us), sender);
  }
  /// Sent `age_us` ago, by a sender whose clock is right.
  Receipt receive(RobotTopic topic, const ros::JointTrajectory& message, uint64_t sender = kFirst,
                  int64_t age_us = 0) {
    return server_.receive(topic, message, {sender, (now_us_ - age_us) * 1000, now_us_});
  }
  /// After that the next messages of a sender, in the tick that has begun, are accepted.
  void start(uint64_t sender = kFirst) {
    for (int i = 0; i < 20; ++i) {
      tick();
      EXPECT_EQ(fingers(0, 0, sender), Receipt::starting);
      EXPECT_EQ(wrist(0, 0, sender), Receipt::starting);
    }
    tick();
  }
  RobotState tick() {
    now_us_ += kPeriodUs;
    const RobotState state = server_.tick({now_us_, kEpochUs + now_us_});
    for (size_t j = 0; j < state.position.size(); ++j) {
      EXPECT_LE(std::abs(state.position[j] - last_.position[j]),
                limits_.hand_joint_speed * kPeriodUs * 1e-6 + kHandRounding)
          << hand_joint_names()[j];
      const ShadowJointInfo& info = shadow_joint_infos()[j];
      EXPECT_GE(state.position[j], radians_from_degrees(info.min_deg));
      EXPECT_LE(state.position[j], radians_from_degrees(info.max_deg));
    }
    for (const int j1 : {kFFJ1, kMFJ1, kRFJ1, kLFJ1})
      EXPECT_NEAR(state.position[j1], std::max(0.0, state.position[j1] + state.position[j1 + 1] - M_PI / 2),
                  kHandRounding);
    const TestFingertips::Tips way = fingertips(state) - fingertips(last_);
    EXPECT_LE(way.colwise().norm().maxCoeff(), limits_.fingertip_speed * kPeriodUs * 1e-6 + 1e-9);
    return last_ = state;
  }
  RobotState ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
    return last_;
  }
  static TestFingertips::Tips fingertips(const RobotState& state) {
    std::array<double, kShadowJointCount> joints;
    std::ranges::copy(state.position, joints.begin());
    return TestFingertips(joints).in_forearm();
  }
  int64_t count(Receipt receipt) const { return server_.stream().count(receipt); }

  CommandLimits limits_;
  std::vector<double> start_ = std::vector<double>(kShadowJointCount, 0.0);
  RobotServer server_{limits_, {}, {start_}};
  int64_t now_us_ = 5'000'000;
  RobotState last_{0, CommandState::stopped, start_, {}};
};

TEST_F(RobotServerHand, StandsUntilSomethingComes) {
  const RobotState state = ticks(10);
  EXPECT_EQ(state.state, CommandState::stopped);
  EXPECT_THAT(state.position, Each(0.0));
  EXPECT_THAT(state.velocity, Each(0.0));
}

TEST_F(RobotServerHand, GoesToTheTargetAtTheSpeedOfTheLimits) {
  start();
  int moving = 0;
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(first_finger(30, 1000 * (i + 1)), Receipt::accepted);
    const RobotState state = tick();
    EXPECT_EQ(state.state, CommandState::following);
    moving += state.velocity[kFFJ3] > 0;
    EXPECT_LE(state.velocity[kFFJ3], 2 + 1e-9);
  }
  EXPECT_EQ(moving, 27) << "30 degrees at 2 rad/s are 0.262 s";
  EXPECT_NEAR(last_.position[kFFJ3], radians_from_degrees(30), kHandRounding);
}

TEST_F(RobotServerHand, SlowsDownAsAWholeForTheFingertips) {
  start();
  for (int i = 0; i < 150; ++i) {
    EXPECT_EQ(fingers(30, 1000 * (i + 1)), Receipt::accepted);
    EXPECT_EQ(wrist(8, 1000 * (i + 1)), Receipt::accepted);
    const RobotState state = tick();  // checks the fingertips
    EXPECT_NEAR(state.position[kWRJ1] / radians_from_degrees(8), state.position[kFFJ3] / radians_from_degrees(30),
                1e-9);
  }
  EXPECT_GT(server_.interventions()[Intervention::fingertip_speed], 0);
  EXPECT_NEAR(last_.position[kFFJ3], radians_from_degrees(30), kHandRounding);
  EXPECT_NEAR(last_.position[kWRJ1], radians_from_degrees(8), kHandRounding);
  EXPECT_GT(server_.interventions()[Intervention::coupling], 0) << "30 and 30 degrees are 60 of the motor, and 0";
  EXPECT_NEAR(last_.position[kFFJ2], radians_from_degrees(60), kHandRounding);
}

TEST(RobotServerCoupling, SplitsByTheCouplingThatItIsTold) {
  CommandLimits limits;
  limits.coupling = ShadowCoupling::even;
  RobotServer server(limits, {}, {std::vector<double>(kShadowJointCount, 0.0)});
  ros::JointTrajectory message = trajectory_message(hand_trajectory_names(), 0, 1);
  message.points[0].positions[kMFJ2] = 1;
  RobotState state;
  for (int64_t now_us = 10'000; now_us < 2'000'000; now_us += 10'000) {
    message.stamp = test_stamp(now_us);
    server.receive(RobotTopic::fingers, message, {kFirst, now_us * 1000, now_us});
    state = server.tick({now_us, kEpochUs + now_us});
  }
  EXPECT_EQ(state.position[kMFJ1], 0.5);
  EXPECT_EQ(state.position[kMFJ2], 0.5);
}

TEST_F(RobotServerHand, NobodyFinishesWhatAnotherBegan) {
  start();
  for (int i = 0; i < 2; ++i) {
    wrist(28, 1000 * (i + 1));
    tick();
  }
  const double stood = ticks(80).position[kWRJ1];  // its sender is dead
  EXPECT_GT(stood, 0);
  EXPECT_LT(stood, radians_from_degrees(25)) << "it was on its way";
  start(kSecond);
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(fingers(10, 1000 * (i + 1), kSecond), Receipt::accepted);
    tick();
  }
  EXPECT_NEAR(last_.position[kFFJ3], radians_from_degrees(10), kHandRounding);
  EXPECT_EQ(last_.position[kWRJ1], stood);
}

TEST_F(RobotServerHand, NothingThatCameBeforeItsFirstTickMovesIt) {
  for (int i = 0; i < 60; ++i, now_us_ += kPeriodUs)
    EXPECT_NE(fingers(90, i), Receipt::accepted) << "more than 0.1 s without a tick are a gap";
  EXPECT_EQ(ticks(3).position, start_);
}

TEST_F(RobotServerHand, HoldsAndThenStopsWhenNothingComes) {
  start();
  first_finger(80, 1);
  EXPECT_EQ(ticks(15).state, CommandState::following);
  const RobotState held = ticks(2);
  EXPECT_EQ(held.state, CommandState::holding);
  EXPECT_EQ(tick().position, held.position);
  EXPECT_EQ(ticks(40).state, CommandState::stopped);
  EXPECT_EQ(last_.position, held.position);
  EXPECT_THAT(last_.velocity, Each(0.0));
  EXPECT_EQ(first_finger(80, 2), Receipt::accepted);
  EXPECT_EQ(tick().state, CommandState::following);
  EXPECT_NEAR(last_.position[kFFJ3] - held.position[kFFJ3], 0.02, kHandRounding) << "from where it stood";
}

TEST_F(RobotServerHand, BadMessagesAreAsIfTheyHadNotCome) {
  start();
  first_finger(10, 1000);
  const RobotState good = ticks(12);
  ros::JointTrajectory bad = trajectory_message(hand_trajectory_names(), 80, 2000);
  bad.points[0].positions[5] = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(receive(RobotTopic::fingers, bad), Receipt::not_finite);
    EXPECT_EQ(fingers(80, 999), Receipt::went_back);
    EXPECT_EQ(fingers(80, 1000), Receipt::went_back) << "the same once more";
    EXPECT_EQ(tick().position, good.position);
  }
  EXPECT_EQ(last_.state, CommandState::holding) << "they do not keep the stream alive";
  EXPECT_EQ(count(Receipt::accepted), 1);
  EXPECT_EQ(count(Receipt::not_finite), 10);
  EXPECT_EQ(count(Receipt::went_back), 20);
}

TEST_F(RobotServerHand, ClampsWhatIsBeyondTheLimits) {
  start();
  for (int i = 1; i < 600; ++i) {
    EXPECT_EQ(fingers(i % 2 ? 1e6 : 500, i), Receipt::accepted);
    tick();  // checks the limits
  }
  EXPECT_NEAR(last_.position[kFFJ3], radians_from_degrees(90), kHandRounding);
  EXPECT_GT(server_.interventions()[Intervention::joint_limit], 0);
}

TEST_F(RobotServerHand, TheFirstSenderOwnsTheStreamUntilItIsSilent) {
  start();
  for (int i = 1; i <= 50; ++i) {
    EXPECT_EQ(fingers(10, i, kFirst), Receipt::accepted);
    EXPECT_EQ(fingers(80, i, kSecond), Receipt::foreign);
    EXPECT_EQ(wrist(5, i, kSecond), Receipt::foreign) << "also on a topic that the owner does not use";
    tick();
  }
  EXPECT_LE(last_.position[kFFJ3], radians_from_degrees(10) + kHandRounding);
  EXPECT_EQ(count(Receipt::foreign), 100);
  int refused = 0;
  while (fingers(20, 1, kSecond) == Receipt::foreign && refused < 1000) {
    ++refused;
    tick();
  }
  EXPECT_EQ(refused, 50) << "0.5 s after the owner's last message, which came one tick before";
  int starting = 0;
  for (; fingers(20, 1, kSecond) == Receipt::starting && starting < 1000; ++starting) tick();
  EXPECT_EQ(starting, 20) << "0.2 s";
  EXPECT_EQ(fingers(20, 2, kSecond), Receipt::accepted);
  EXPECT_EQ(server_.stream().owners(), 2);
  EXPECT_EQ(fingers(80, 1000, kFirst), Receipt::foreign) << "who comes back has to wait as well";
}

TEST_F(RobotServerHand, AnOwnerThatHasGoneIsFollowedByTheNext) {
  start();
  EXPECT_EQ(fingers(10, 1'000'000, kFirst), Receipt::accepted);
  server_.stream().keep_only({kFirst, kSecond});
  EXPECT_EQ(fingers(10, 1, kSecond), Receipt::foreign);
  server_.stream().keep_only({kSecond});
  start(kSecond);
  EXPECT_EQ(fingers(10, 1, kSecond), Receipt::accepted) << "its stamps begin anew";
}

TEST_F(RobotServerHand, BadMessagesDoNotMakeAnOwner) {
  start();
  EXPECT_EQ(receive(RobotTopic::fingers, ros::JointTrajectory(), kSecond), Receipt::wrong_joints);
  EXPECT_EQ(fingers(10, 1, kFirst), Receipt::accepted);
}

TEST_F(RobotServerHand, StampsOfZeroMeanNow) {
  start();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(fingers(10, 0), Receipt::accepted);
  EXPECT_EQ(fingers(10, 1), Receipt::accepted);
  EXPECT_EQ(fingers(10, 0), Receipt::went_back);
}

TEST_F(RobotServerHand, AFloodMovesNothingFaster) {
  start();
  int64_t stamp = 0;
  for (int i = 0; i < 20; ++i) {
    for (int m = 0; m < 1000; ++m) EXPECT_EQ(first_finger(m % 2 ? 90 : 0, ++stamp), Receipt::accepted);
    tick();
  }
  EXPECT_EQ(count(Receipt::accepted), 20'000);
  EXPECT_NEAR(last_.position[kFFJ3], 20 * 0.02, kHandRounding) << "the last one before a tick counts";
}

TEST_F(RobotServerHand, WhatWaitedThroughAStandstillMovesNothing) {
  start();
  for (int i = 1; i <= 10; ++i, tick()) EXPECT_EQ(fingers(5, i), Receipt::accepted);
  now_us_ += 6'500'000;  // stopped; its sender is dead, and commands of 1.5 s wait
  const std::vector<double> stood = last_.position;
  for (int i = 0; i < 150; ++i)
    EXPECT_NE(receive(RobotTopic::fingers, trajectory_message(hand_trajectory_names(), 80, 11 + i), kFirst,
                      6'500'000 - i * 10'000),
              Receipt::accepted);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tick().position, stood);
  EXPECT_EQ(last_.state, CommandState::stopped);
  EXPECT_EQ(count(Receipt::stale), 150);
  EXPECT_EQ(server_.stream().gaps(), 1);
}

TEST_F(RobotServerHand, OwnGapsNeedANewStart) {
  start();
  for (int i = 1; i <= 10; ++i, tick()) EXPECT_EQ(fingers(80, i), Receipt::accepted);
  now_us_ += 95'000;  // the next tick is 105 ms after the last one
  const std::vector<double> stood = last_.position;
  EXPECT_EQ(fingers(80, 11), Receipt::accepted) << "95 ms after the last tick";
  EXPECT_EQ(tick().position, stood) << "it was on its way, but now it holds";
  EXPECT_EQ(last_.state, CommandState::holding);
  int refused = 0;
  for (; fingers(80, 12 + refused) != Receipt::accepted; ++refused) EXPECT_EQ(tick().position, stood);
  EXPECT_EQ(refused, 30) << "0.1 s in which all is stale, 0.2 s of a start";
  EXPECT_NE(tick().position, stood);
  EXPECT_EQ(server_.stream().owners(), 2);
}

TEST_F(RobotServerHand, ALateCommandMovesNothing) {
  start();
  for (int i = 1; i <= 10; ++i, tick()) EXPECT_EQ(fingers(5, i), Receipt::accepted);
  EXPECT_EQ(ticks(16).state, CommandState::holding);
  const ros::JointTrajectory message = trajectory_message(hand_trajectory_names(), 80, 20);
  EXPECT_EQ(receive(RobotTopic::fingers, message, kFirst, 151'000), Receipt::stale);
  EXPECT_EQ(receive(RobotTopic::fingers, message, kFirst, 120'000), Receipt::accepted);
  EXPECT_EQ(tick().state, CommandState::following) << "it is 130 ms old";
  EXPECT_EQ(ticks(2).state, CommandState::following);
  EXPECT_EQ(tick().state, CommandState::holding) << "160 ms";
}

TEST_F(RobotServerHand, AnOldTargetOfTheWristIsNotFollowedWhileTheFingersAre) {
  start();
  EXPECT_EQ(wrist(28, 1), Receipt::accepted);
  std::vector<double> angles;
  for (int i = 1; i <= 40; ++i) {
    fingers(80, i);
    angles.push_back(tick().position[kWRJ1]);
  }
  EXPECT_GT(angles[14], angles[13]);
  EXPECT_EQ(angles[15], angles[14]) << "0.15 s after its last message";
  EXPECT_EQ(angles[39], angles[14]);
}

TEST_F(RobotServerHand, HoldsWhileItMayNotMoveAndGoesOnThen) {
  start();
  first_finger(80, 1);
  for (int i = 0; i < 3; ++i, now_us_ += kPeriodUs)
    EXPECT_EQ(server_.tick({now_us_ + kPeriodUs, kEpochUs + now_us_ + kPeriodUs}, false).position, start_);
  EXPECT_EQ(tick().state, CommandState::following) << "without another message";
  EXPECT_NEAR(last_.position[kFFJ3], 0.02, kHandRounding) << "and without making up for what it missed";
}

TEST_F(RobotServerHand, AClockThatIsSetIsAGap) {
  start();
  for (int i = 1; i <= 10; ++i, tick()) EXPECT_EQ(fingers(80, i), Receipt::accepted);
  now_us_ += kPeriodUs;
  const std::vector<double> stood = last_.position;
  EXPECT_EQ(server_.tick({now_us_, kEpochUs + now_us_ + 101'000}).position, stood);
  EXPECT_EQ(server_.stream().gaps(), 1);
}

}  // namespace
}  // namespace glovebench
