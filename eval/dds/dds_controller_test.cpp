// `track` with a robot's controllers starts where the robot is measured to stand.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "ci/build_paths.h"
#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/dds_sink.h"
#include "core/adapters/dds/measured_robot.h"
#include "core/adapters/system_time.h"
#include "core/base/math.h"
#include "core/robot/arm.h"
#include "core/robot/command_guard.h"
#include "core/robot/shadow_kinematics.h"
#include "core/robot/test_commands.h"
#include "core/test_error.h"
#include "eval/command_test.h"
#include "eval/commands/robot_outputs.h"
#include "eval/dds/test_programs.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kControllerRounding = 1e-9;

class DdsController : public DdsBus {
 protected:
  static const inline ProgramSetting kController = {.environment = {{"DDS_PROBE_TOPICS", "controller"}}};

  static std::string values(const std::vector<std::string>& names, const std::vector<double>& positions) {
    std::string text;
    for (size_t j = 0; j < names.size(); ++j) text += fmt::format(" {}={}", names[j], positions.at(j));
    return text;
  }
  /// Half open, unlike any tracked hand at the start.
  static std::vector<double> standing() {
    std::vector<double> positions(kShadowJointCount);
    for (int j = 0; j < kShadowJointCount; ++j) {
      const ShadowJointInfo& info = shadow_joint_infos()[j];
      positions[j] = radians_from_degrees(0.3 * info.min_deg + 0.7 * info.max_deg);
    }
    return positions;
  }
  /// A driver that reports joints a hundred times a second until it is stopped.
  StartedProgram drive(const std::string& topic, const std::vector<std::string>& names,
                       const std::vector<double>& positions, const ProgramSetting& setting = {}) {
    return talk("wait " + topic + "\nstate " + topic + values(names, positions) + "\nagain 100000 10000\n",
                setting);
  }
  StartedProgram listen_to_controller() { return listen("4", kController); }
  static std::map<std::string, double> joints_of(const std::string& line) {
    std::map<std::string, double> joints;
    std::istringstream words(line);
    for (std::string word; words >> word;)
      if (const size_t equals = word.find('='); equals != std::string::npos)
        joints[word.substr(0, equals)] = std::stod(word.substr(equals + 1));
    return joints;
  }
  /// When the controller must reach the targets of a message, s: a microsecond later than it says.
  static double time_of(const std::string& line) {
    return std::stod(line.substr(line.find(" point ") + std::string_view(" point ").size())) + 1e-6;
  }
  /// When the controller received a message.
  static double received_s(const std::string& line) {
    return static_cast<double>(std::stoll(line.substr(line.rfind(' ') + 1))) * 1e-9;
  }
  RobotBusOptions controllers(bool arm) const {
    RobotBusOptions options;
    options.domain = std::stoi(domain_);
    options.to_controller = true;
    options.arm = arm;
    return options;
  }
  /// A tracked frame whose joints are all at 0.
  static RobotCommand command(int i) { return good_command(1'000'000 + 33'333 * int64_t{i}); }
  /// Sends commands as `track` does.
  static void send(RobotOutputs& outputs, int count) {
    CommandGuard guard;
    for (int i = 0; i < count; ++i) {
      outputs.send(guard, command(i), system_us());
      std::this_thread::sleep_for(std::chrono::milliseconds(33));
    }
    outputs.finish();
  }
  /// True if the command is sent without an Error.
  static bool is_sent(RobotOutputs& outputs, CommandGuard& guard, int i) {
    try {
      outputs.send(guard, command(i), system_us());
      return true;
    } catch (const Error&) {
      return false;
    }
  }
  /// While the hand is lost, somebody bends the fingers; the next command must start there.
  void expect_asked_again(double stop_after_s) {
    const StartedProgram listener = listen("60", kController);
    const auto heard = [&] { return lines_of("hand", said(listener)).size(); };
    const StartedProgram before =
        drive("measured", hand_joint_names(), std::vector<double>(kShadowJointCount, 0.0));
    RobotOutputs outputs("", controllers(false));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CommandLimits limits;
    limits.stop_after_s = stop_after_s;
    CommandGuard guard(limits);
    for (int i = 0; i < 5; ++i) outputs.send(guard, command(i), system_us());
    ASSERT_TRUE(comes_true([&] { return heard() == 5; }));
    stop(before, SIGKILL);
    const StartedProgram after = drive("measured", hand_joint_names(), standing());
    outputs.send(guard, lost_command(2'000'000), system_us());
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    int sent = 60;
    ASSERT_TRUE(comes_true([&] { return is_sent(outputs, guard, ++sent); }))
        << "the driver that was killed is forgotten";
    outputs.finish();
    stop(after, SIGKILL);
    ASSERT_TRUE(comes_true([&] { return heard() == 6; }));
    const std::vector<std::string> hands = lines_of("hand", stop(listener, SIGTERM).out);
    const double farthest = limits.hand_joint_speed * limits.longest_step_s + kControllerRounding;
    for (const auto& [name, angle] : joints_of(hands.back())) {
      const auto joint = std::find(hand_joint_names().begin(), hand_joint_names().end(), name);
      ASSERT_NE(joint, hand_joint_names().end());
      EXPECT_LE(std::abs(angle - standing()[joint - hand_joint_names().begin()]), farthest) << name;
    }
  }
  static std::string refusal(const RobotBusOptions& options) {
    return thrown_by([&] { RobotOutputs outputs("", options); });
  }
};

TEST_F(DdsController, HearsNothingUnlessItIsMeant) {
  const StartedProgram controllers = listen_to_controller();
  const StartedProgram servers = listen();
  DdsSink sink(std::stoi(domain_));
  ASSERT_TRUE(comes_true([&] { return sink.listeners() > 0; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  for (int i = 0; i < 30; ++i) sink.send(command(i));
  sink.finish();
  EXPECT_EQ(lines_of("hand", finish(servers).out).size(), 30U);
  const ProgramRun heard = stop(controllers, SIGTERM);
  EXPECT_EQ(heard.out, "ready\n");
}

TEST_F(DdsController, IsLeftNoFasterThanTheLimitsFromWhereTheRobotStands) {
  for (const bool own_topic : {true, false}) {
    const StartedProgram driver = own_topic ? drive("measured", hand_joint_names(), standing())
                                            : drive("states", hand_joint_names(), standing(), kController);
    const StartedProgram listener = listen_to_controller();
    RobotOutputs outputs("", controllers(false));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // for discovery of the sender
    send(outputs, 20);
    stop(driver, SIGKILL);
    const std::string heard = finish(listener).out;
    const std::vector<std::string> hands = lines_of("hand", heard), wrists = lines_of("wrist", heard);
    ASSERT_EQ(hands.size(), 20U);
    ASSERT_EQ(wrists.size(), 20U);
    EXPECT_THAT(lines_of("pose", heard), IsEmpty());
    std::map<std::string, double> before;
    for (size_t j = 0; j < standing().size(); ++j) before[hand_joint_names()[j]] = standing()[j];
    for (size_t i = 0; i < hands.size(); ++i) {
      std::map<std::string, double> now = joints_of(hands[i]);
      now.merge(joints_of(wrists[i]));
      EXPECT_NEAR(time_of(hands[i]), 0.1, 2e-6) << "whatever lies between two commands";
      const double farthest = i == 0 ? 1e-5 : CommandLimits().hand_joint_speed * time_of(hands[i]);
      ASSERT_EQ(now.size(), size_t{kShadowJointCount});
      for (const auto& [name, angle] : now) {
        ASSERT_LE(std::abs(angle - before.at(name)), farthest) << name << " in message " << i;
        const bool coupled = name.ends_with("FJ1") || name.ends_with("FJ2");
        const double most = coupled ? std::numbers::pi : std::abs(before.at(name)) + kControllerRounding;
        ASSERT_LE(std::abs(angle), most) << name << " goes to 0";
      }
      for (const std::string finger : {"rh_FF", "rh_MF", "rh_RF", "rh_LF"}) {
        const auto motor = [&](const auto& joints) { return joints.at(finger + "J1") + joints.at(finger + "J2"); };
        ASSERT_LE(motor(now), motor(before) + kControllerRounding)
            << finger << " goes to 0, each joint as the motor moves it";
      }
      before = now;
    }
    EXPECT_LT(std::abs(before.at("rh_FFJ3")), std::abs(standing()[kFFJ3]) / 2) << "it does get there";
  }
}

TEST_F(DdsController, IsNotSpokenToWithoutACompleteMeasuredState) {
  EXPECT_THAT(
      refusal(controllers(false)),
      AllOf(HasSubstr("DDS domain 7: measured state of the hand: found nothing of them on "
                      "/glovebench/measured_joint_states, nothing of them on /joint_states, expected all 24 "
                      "joints (rh_FFJ1 ... rh_WRJ2), at most 0.1 s old")));
  std::vector<std::string> names(hand_joint_names().begin(), hand_joint_names().end() - 2);
  const StartedProgram fingers = drive("measured", names, standing());
  EXPECT_THAT(refusal(controllers(false)), HasSubstr("a state without rh_WRJ1, rh_WRJ2 on /glovebench/measured"));
  stop(fingers, SIGKILL);
  drive("measured", hand_joint_names(), standing());
  EXPECT_EQ(refusal(controllers(false)), "");
  EXPECT_THAT(refusal(controllers(true)), AllOf(HasSubstr("measured state of the arm: found nothing of them on "),
                                                HasSubstr("expected all 7 joints (S1 ... W2)")));
}

TEST_F(DdsController, IsSpokenToByOneAlone) {
  drive("measured", hand_joint_names(), standing());
  {
    RobotOutputs outputs("", controllers(false));
    EXPECT_THAT(
        refusal(controllers(false)),
        testing::MatchesRegex("DDS domain 7: rt/rh_(wr_)?trajectory_controller/command: found another process "
                              "that writes it, .*"));
    const StartedProgram listener = listen_to_controller();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CommandGuard guard;
    EXPECT_NO_THROW(outputs.send(guard, command(1), system_us())) << "who was refused does not disturb it";
    EXPECT_EQ(lines_of("hand", finish(listener).out).size(), 1U);
    DdsSinkOptions unaware;
    unaware.topics = topics::kController;
    const DdsSink other(std::stoi(domain_), unaware);
    int sent = 1;
    EXPECT_TRUE(comes_true([&] { return !is_sent(outputs, guard, ++sent); }))
        << "two that began at once see each other now";
  }
  EXPECT_EQ(refusal(controllers(false)), "") << "they are gone";
}

TEST_F(DdsController, IsNotSpokenToAfterItsDriverFellSilent) {
  const StartedProgram driver = drive("measured", hand_joint_names(), standing());
  RobotOutputs outputs("", controllers(false));
  stop(driver, SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const StartedProgram listener = listen_to_controller();
  CommandGuard guard;
  EXPECT_NO_THROW(outputs.send(guard, lost_command(1), system_us()));  // a lost command is not sent anyway
  EXPECT_THROW(outputs.send(guard, command(2), system_us()), Error);
  EXPECT_EQ(stop(listener, SIGTERM).out, "ready\n");
}

TEST_F(DdsController, IsAskedAgainWhereTheRobotStandsAfterALostHandWhenItHasStopped) { expect_asked_again(0.5); }

TEST_F(DdsController, IsAskedAgainWhereTheRobotStandsAfterALostHandWhileItHolds) { expect_asked_again(60); }

TEST_F(DdsController, HearsABurstOfFramesNoFasterThanTheClockOfTheWall) {
  const StartedProgram driver = drive("measured", hand_joint_names(), standing());
  const StartedProgram listener = listen_to_controller();
  RobotOutputs outputs("", controllers(false));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // for discovery of the sender
  CommandGuard guard;
  for (int i = 0; i < 200; ++i) outputs.send(guard, command(i), system_us());  // 6.6 s by their time stamps
  outputs.finish();
  stop(driver, SIGKILL);
  const std::vector<std::string> hands = lines_of("hand", finish(listener).out);
  ASSERT_GE(hands.size(), 2U);
  const double elapsed = received_s(hands.back()) - received_s(hands.front());
  ASSERT_LT(elapsed, 3);
  // A busy machine may deliver the first message late.
  const double farthest = CommandLimits().hand_joint_speed * (elapsed + 0.1);
  for (const auto& [name, angle] : joints_of(hands.back())) {
    const auto joint = std::find(hand_joint_names().begin(), hand_joint_names().end(), name);
    EXPECT_LE(std::abs(angle - standing()[joint - hand_joint_names().begin()]), farthest) << name;
  }
}

TEST_F(DdsController, StartsTheArmWhereItStands) {
  const StartedProgram hand = drive("measured", hand_joint_names(), std::vector<double>(kShadowJointCount, 0.0));
  const StartedProgram listener = listen_to_controller();
  const ArmJoints rest = kArmAtRest;
  // The arm's own controller reports on another topic.
  const StartedProgram arm = drive("states", arm_joint_names(), {rest.begin(), rest.end()}, kController);
  RobotOutputs outputs("", controllers(true));
  ASSERT_TRUE(outputs.arm_start());
  EXPECT_EQ(*outputs.arm_start(), rest);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  send(outputs, 3);
  stop(hand, SIGKILL), stop(arm, SIGKILL);
  const std::string heard = finish(listener).out;
  const std::vector<std::string> poses = lines_of("pose", heard), hands = lines_of("hand", heard);
  ASSERT_EQ(poses.size(), 3U);
  ASSERT_EQ(hands.size(), 3U);
  Eigen::Vector3d before = (arm_flange_pose(rest) * default_T_flange_wrist()).translation();
  const Eigen::Vector3d goal =
      Eigen::Vector3d(0.5, 0, 0.5) + shadow_T_wrist_hand(command(0).targets->hand.joints).inverse().translation();
  for (size_t i = 0; i < poses.size(); ++i) {
    std::istringstream words(poses[i].substr(poses[i].find('"')));
    std::string frame;
    Eigen::Vector3d now;
    words >> frame >> now.x() >> now.y() >> now.z();
    // The wrist turns about the hand's origin, to which the limits apply.
    constexpr double kWristFromHand = 0.15;
    EXPECT_LE((now - before).norm(),
              (CommandLimits().hand_speed + kWristFromHand * CommandLimits().hand_turn_speed) * time_of(hands[i]));
    before = now;
  }
  EXPECT_GT((before - goal).norm(), 0.01) << "it is still on its way";
}

TEST(MeasuredTargets, TakeNoiseAsTheLimit) {
  MeasuredState state{std::vector<double>(kShadowJointCount, 0.0), std::nullopt};
  state.hand[kFFJ3] = radians_from_degrees(90.9);
  state.hand[kMFJ1] = radians_from_degrees(20.9);
  state.hand[kMFJ2] = radians_from_degrees(20);
  const Eigen::Isometry3d T_base_hand = good_command(1).targets->T_base_hand;
  const RobotTargets targets = targets_at(state, default_T_flange_wrist(), T_base_hand);
  EXPECT_EQ(targets.hand.joints[kFFJ3], radians_from_degrees(90));
  EXPECT_EQ(targets.hand.joints[kMFJ1], radians_from_degrees(20));
  CommandGuard guard;
  EXPECT_NO_THROW(guard.start_from(targets));
  state.hand[kFFJ3] = radians_from_degrees(92);
  EXPECT_THROW(targets_at(state, default_T_flange_wrist(), T_base_hand), Error);
  state.hand[kFFJ3] = 0;
  state.hand[kMFJ1] = radians_from_degrees(22);
  EXPECT_THROW(targets_at(state, default_T_flange_wrist(), T_base_hand), Error);
}

/// From frames to a controller.
class DdsControllerTrack : public CommandTest {};

/// A recording, tracked faster than it was taken.
class DdsControllerRecording : public DdsController {
 protected:
  static constexpr int kLength = 46;
  static constexpr double kSpan = (kLength - 1) / 30.0;  // s
};

TEST_F(DdsControllerRecording, IsNoFasterByTheClockOfTheWall) {
  write_file(path("closing.json"), make_trajectory_json("closing", kLength).dump());
  ASSERT_EQ(
      run_glovebench({"render", "--trajectory", path("closing.json"), "--format", "fakenect", "-o", path("dump")})
          .exit_code,
      0);
  const StartedProgram driver = drive("measured", hand_joint_names(), standing());
  const StartedProgram listener = listen_to_controller();
  const ProgramRun tracked = run_glovebench({"track", "--source", "fakenect:" + path("dump"), "--database",
                                             "DB_open_power", "-o", path("e.jsonl"), "--robot", "dds:" + domain_,
                                             "--robot-topics", "controller", "--robot-arm", "none"});
  EXPECT_EQ(tracked.exit_code, 0) << tracked.err;
  stop(driver, SIGKILL);
  const std::vector<std::string> hands = lines_of("hand", finish(listener).out);
  ASSERT_GE(hands.size(), 3U);
  // A busy machine may deliver the first message late.
  constexpr double kLate = kSpan / 3;
  const double elapsed = received_s(hands.back()) - received_s(hands.front()) + kLate;
  EXPECT_GE(elapsed, kSpan);
  std::map<std::string, double> ways, before = joints_of(hands.front());
  for (const std::string& line : hands) {
    const std::map<std::string, double> now = joints_of(line);
    for (const auto& [name, angle] : now) ways[name] += std::abs(angle - before.at(name));
    before = now;
  }
  for (const auto& [name, way] : ways) EXPECT_LE(way, CommandLimits().hand_joint_speed * elapsed) << name;
}

TEST_F(DdsControllerTrack, TrackNeedsAMeasuredState) {
  use_loopback_dds();
  render_recording("good.json", "dump");
  const std::vector<std::string> flags = {"--robot",    "dds:7",       "--robot-topics",
                                          "controller", "--robot-arm", "none"};
  EXPECT_THAT(refusal(track("dump", "DB_open_power", "e.jsonl", flags)),
              HasSubstr("measured state of the hand: found nothing of them on /glovebench/measured_joint_states"));
  EXPECT_FALSE(std::filesystem::exists(path("e.jsonl")));
  std::string script = "wait measured\nstate measured";
  for (const std::string& name : hand_joint_names()) script += fmt::format(" {}=0.1", name);
  write_file(path("script"), script + "\nagain 20000 10000\n");
  const StartedProgram driver = start_program({build_paths::program("dds_probe"), "talk", "7", path("script")});
  std::vector<std::string> more = flags;
  more.insert(more.end(), {"--robot-out", path("r.jsonl")});
  expect_fine(track("dump", "DB_open_power", "e.jsonl", more));
  kill(driver.process, SIGKILL);
  finish_program(driver);
  std::istringstream lines(read_file(path("r.jsonl")));
  std::string first;
  ASSERT_TRUE(std::getline(lines, first));
  const nlohmann::json command = nlohmann::json::parse(first);
  for (const auto& [name, angle_deg] : command.at("joints").at("target_deg").items())
    EXPECT_NEAR(angle_deg.get<double>(), degrees_from_radians(0.1), 1e-3) << name;
  EXPECT_THAT(refusal(track("dump", "DB_open_power", "e.jsonl", {"--robot-topics", "controller"})),
              HasSubstr("--robot-topics"));
}

}  // namespace
}  // namespace glovebench::eval
