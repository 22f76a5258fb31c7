#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "core/base/random.h"
#include "core/base/sanitizers.h"
#include "core/robot/test_commands.h"
#include "core/robot/test_stream_checker.h"

namespace glovebench {
namespace {

constexpr int kInputsPerStream = 500;

/// Everything that a broken, restarted, delayed or malicious sender may say, most of it after a few good commands.
class HostileSender {
 public:
  explicit HostileSender(uint64_t seed) : random_(1, "hostile", static_cast<int64_t>(seed), "commands") {
    calm_ = random_.uniform(0.3, 0.98);
    now_us_ = random_.uniform() < 0.1 ? static_cast<int64_t>(random_.bits()) : 1'000'000;
    stamp_us_ = random_.uniform() < 0.1 ? static_cast<int64_t>(random_.bits()) : 0;
  }

  int64_t next_time() { return now_us_ = advanced(now_us_); }
  bool dies() { return random_.uniform() < 0.2; }
  RobotCommand next_command() {
    command_.timestamp_us = stamp_us_ = advanced(stamp_us_);
    command_.frame_timestamp_us = is_calm() ? stamp_us_ : advanced(command_.frame_timestamp_us);
    wander();
    RobotCommand sent = command_;
    if (is_calm()) return sent;
    if (random_.uniform() < 0.3) spoil_state(sent);
    for (int i = 0; sent.targets && i < 3; ++i) spoil(*sent.targets);
    return sent;
  }

 private:
  bool is_calm() { return random_.uniform() < calm_; }

  int64_t advanced(int64_t time_us) {
    const auto add = [&](int64_t step) {
      return static_cast<int64_t>(static_cast<uint64_t>(time_us) + static_cast<uint64_t>(step));
    };
    if (is_calm()) return add(static_cast<int64_t>(random_.uniform(1, 100'000)));
    switch (random_.index(8)) {
      case 0:
        return time_us;
      case 1:
        return add(1);
      case 2:
        return add(-static_cast<int64_t>(random_.uniform(1, 1e6)));
      case 3:
        return add(static_cast<int64_t>(random_.uniform(1e5, 2e6)));
      case 4:
        return add(static_cast<int64_t>(random_.uniform(1, 1e15)));
      case 5:
        return random_.uniform() < 0.02 ? std::numeric_limits<int64_t>::max() : add(2);
      case 6:
        return random_.uniform() < 0.02 ? std::numeric_limits<int64_t>::min() : add(3);
      default:
        return random_.uniform() < 0.02 ? static_cast<int64_t>(random_.bits()) : add(33'333);
    }
  }

  /// The movement that a good sender makes; now and then too fast, or out of the limits.
  void wander() {
    if (!command_.targets) return;
    RobotTargets& targets = *command_.targets;
    const double speed = is_calm() ? 0.05 : 2;
    for (double& q : targets.hand.joints) q += speed * random_.uniform(-1, 1);
    for (double& q : targets.hand.joints) q = std::clamp(q, -2.0, 2.0);
    targets.T_base_hand.translate(
        0.1 * speed * Eigen::Vector3d(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)));
    targets.T_base_hand.rotate(Eigen::AngleAxisd(
        speed * random_.uniform(-1, 1), Eigen::Vector3d(random_.normal(), random_.normal(), 1).normalized()));
    const Eigen::Matrix3d R = targets.T_base_hand.linear();
    targets.T_base_hand.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
    if (random_.uniform() < 0.05) targets.arm = targets.arm ? std::nullopt : std::optional<ArmJoints>(ArmJoints{});
    for (int j = 0; targets.arm && j < kArmJointCount; ++j) (*targets.arm)[j] += speed * random_.uniform(-1, 1);
  }

  void spoil_state(RobotCommand& command) {
    command.status = static_cast<TrackStatus>(random_.index(kCountOf<TrackStatus>));
    command.state = static_cast<CommandState>(random_.index(kCountOf<CommandState>));
    command.hold = random_.uniform() < 0.5;
    if (random_.uniform() < 0.3) command.targets.reset();
    if (random_.uniform() < 0.3)
      command.interventions.add(static_cast<Intervention>(random_.index(kCountOf<Intervention>)),
                                static_cast<int64_t>(random_.bits() >> 1));
  }

  double hostile_value() {
    using Limits = std::numeric_limits<double>;
    switch (random_.index(9)) {
      case 0:
        return Limits::quiet_NaN();
      case 1:
        return Limits::infinity();
      case 2:
        return -Limits::infinity();
      case 3:
        return Limits::max();
      case 4:
        return Limits::lowest();
      case 5:
        return Limits::denorm_min() * static_cast<double>(1 + random_.index(9));
      case 6:
        return -0.0;
      case 7:
        return std::bit_cast<double>(random_.bits());
      default:
        return random_.uniform(-1e4, 1e4);
    }
  }
  void spoil(RobotTargets& targets) {
    Eigen::Isometry3d& T = targets.T_base_hand;
    switch (random_.index(8)) {
      case 0:
        targets.hand.joints[random_.index(kShadowJointCount)] = hostile_value();
        break;
      case 1:
        targets.hand.actuators[random_.index(kShadowActuatorCount)] = hostile_value();
        break;
      case 2:
        T.translation()[static_cast<int>(random_.index(3))] = hostile_value();
        break;
      case 3:
        T.linear()(static_cast<int>(random_.index(3)), static_cast<int>(random_.index(3))) = hostile_value();
        break;
      case 4:
        T.linear() *= 1 + std::pow(10, random_.uniform(-9, 1)) * random_.uniform(-1, 1);
        break;
      case 5:
        T.linear().col(0) *= -1;
        break;
      case 6:
        if (targets.arm) (*targets.arm)[random_.index(kArmJointCount)] = hostile_value();
        break;
      default:
        targets.hand.joints.fill(hostile_value());
    }
  }

  RandomStream random_;
  double calm_;  ///< share of what is as it should be
  int64_t now_us_, stamp_us_;
  RobotCommand command_ = good_command(0);
};

CommandLimits limits_of(uint64_t seed) {
  CommandLimits limits;
  if (seed % 4 == 1) limits.coupling = ShadowCoupling::even;
  if (seed % 3 != 0) return limits;
  limits.hand_joint_speed = 0.3;
  limits.hand_speed = 0.05;
  limits.hand_turn_speed = 4;  // past half a turn in a second
  limits.fingertip_speed = 0.15;
  limits.arm_speed_share = 0.1;
  limits.longest_step_s = 1.5;
  limits.workspace_min = {0.3, -0.2, 0.1};
  limits.workspace_max = {0.8, 0.2, 0.5};
  return limits;
}

/// A robot whose fingers touch something: J1 and J2 stand anywhere that they can.
RobotTargets start_of(uint64_t seed, const CommandLimits& limits) {
  RandomStream random(1, "hostile", static_cast<int64_t>(seed), "start");
  RobotTargets targets;
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    targets.hand.joints[info.joint] = random.uniform(0, 1.57);
    targets.hand.joints[*info.coupled_joint] = random.uniform(0, targets.hand.joints[info.joint]);
  }
  make_actuators(targets.hand);
  targets.T_base_hand.translation() = (limits.workspace_min + limits.workspace_max) / 2;
  return targets;
}

struct Tally {
  int64_t inputs = 0, sent = 0, followed = 0;
  Interventions interventions;
};

/// A stream through a guard; every other one is timed by its own stamps, the rest by a receiver's clock with ticks.
void run_stream(uint64_t seed, Tally& tally) {
  HostileSender sender(seed);
  const CommandLimits limits = limits_of(seed);
  CommandGuard guard(limits);
  StreamChecker checker(limits);
  if (seed % 5 == 0) {
    guard.start_from(start_of(seed, limits));
    checker.start(start_of(seed, limits));
  }
  Interventions told;
  const bool has_clock = seed % 2 == 0;
  for (int i = 0; i < kInputsPerStream; ++i, ++tally.inputs) {
    std::optional<RobotCommand> sent;
    if (has_clock && sender.dies())
      sent = guard.tick(sender.next_time());
    else if (has_clock)
      sent = guard.guard(sender.next_command(), sender.next_time());
    else
      sent = guard.guard(sender.next_command());
    if (!sent) continue;
    ASSERT_EQ(checker.problem(*sent), "") << "stream " << seed << ", input " << i;
    ++tally.sent;
    tally.followed += sent->state == CommandState::following;
    told.add(sent->interventions);
  }
  for (const Intervention kind : all_values<Intervention>()) {
    ASSERT_LE(told[kind], guard.interventions()[kind]) << to_string(kind);
    // Only commands that came after time had ended were not told of.
    if (kind == Intervention::stale) continue;
    ASSERT_EQ(told[kind], guard.interventions()[kind]) << to_string(kind);
  }
  tally.interventions.add(guard.interventions());
}

void run_streams(uint64_t first, int count) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    run_stream(first + static_cast<uint64_t>(i), tally);
    if (testing::Test::HasFatalFailure()) return;
  }
  // The inputs are hostile, but not so much that the guard only refuses.
  EXPECT_GT(tally.sent, tally.inputs / 3);
  EXPECT_GT(tally.followed, tally.inputs / 10);
  for (const Intervention kind : all_values<Intervention>())
    EXPECT_GT(tally.interventions[kind], 0) << to_string(kind);
}

TEST(CommandGuardHostile, NothingThatHurtsLeaves) { run_streams(1, 100); }

TEST(CommandGuardHostile, NothingThatHurtsLeavesInManyInputs) {
  run_streams(1'000, kHasAddressSanitizer ? 100 : 2'000);
}

TEST(StreamChecker, SeesWhatTheGuardWouldLetThrough) {
  // The same streams without a guard: the checker complains of each in its own words.
  std::map<std::string, int> problems;
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    HostileSender sender(seed);
    StreamChecker checker{CommandLimits()};
    for (int i = 0; i < 100; ++i) ++problems[checker.problem(sender.next_command())];
  }
  for (const char* problem : {"a time stamp that does not rise", "a frame stamp that goes back",
                              "hold and state that contradict each other", "nothing to follow",
                              "a joint outside its limits", "J1 above J2", "a motor that does not fit its joints"})
    EXPECT_GT(problems[problem], 0) << problem;
}

TEST(StreamChecker, SeesEachViolationByItself) {
  const auto problem_after = [](const std::function<void(RobotCommand&)>& spoil) {
    StreamChecker checker{CommandLimits()};
    RobotCommand command = good_command(0);
    command.targets->arm = ArmJoints{};
    EXPECT_EQ(checker.problem(command), "");
    command.timestamp_us = command.frame_timestamp_us = 10'000;
    spoil(command);
    return checker.problem(command);
  };
  using Command = RobotCommand;
  EXPECT_EQ(problem_after([](Command&) {}), "");
  EXPECT_EQ(problem_after([](Command& c) { set_joint(*c.targets, kFFJ3, 0.021); }), "a joint too fast");
  EXPECT_EQ(problem_after([](Command& c) { c.targets->T_base_hand.translation().x() += 0.0026; }),
            "a hand too fast");
  EXPECT_EQ(problem_after([](Command& c) { c.targets->T_base_hand.translation().z() = -0.1; }),
            "a hand outside the workspace");
  EXPECT_EQ(problem_after([](Command& c) { c.targets->T_base_hand.translation().z() = 0.14; }),
            "a fingertip outside the workspace")
      << "its fingers point down";
  EXPECT_EQ(problem_after([](Command& c) {
              c.targets->T_base_hand.translation().y() -= 0.0025;
              set_joint(*c.targets, kFFJ3, 0.02);
              set_joint(*c.targets, kFFJ2, 0.02);
            }),
            "a fingertip too fast")
      << "hand and joints are not";
  EXPECT_EQ(problem_after([](Command& c) {
              set_joint(*c.targets, kFFJ2, 0.02);
              set_joint(*c.targets, kFFJ1, 0.01);
            }),
            "J1 and J2 apart");
  EXPECT_EQ(problem_after([](Command& c) {
              c.targets->T_base_hand.rotate(Eigen::AngleAxisd(0.016, Eigen::Vector3d::UnitX()));
            }),
            "a hand that turns too fast");
  EXPECT_EQ(problem_after([](Command& c) { c.targets->T_base_hand.linear() *= 1.001; }), "a rotation that is none");
  EXPECT_EQ(problem_after([](Command& c) { (*c.targets->arm)[0] = 0.01; }), "an arm joint too fast");
  EXPECT_EQ(problem_after([](Command& c) { (*c.targets->arm)[1] = 2; }), "an arm joint outside its limits");
  EXPECT_EQ(problem_after([](Command& c) { c.targets->arm.reset(); }), "an arm that vanishes");
  EXPECT_EQ(problem_after([](Command& c) { c.targets.reset(), c.hold = true, c.state = CommandState::stopped; }),
            "targets that vanish");
  EXPECT_EQ(problem_after([](Command& c) {
              c.hold = true;
              c.state = CommandState::holding;
              set_joint(*c.targets, kFFJ3, 0.001);
            }),
            "a joint too fast")
      << "what is held does not move";
}

}  // namespace
}  // namespace glovebench
