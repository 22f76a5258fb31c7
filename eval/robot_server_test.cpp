// The servers of hand and arm as processes, with other processes that send to them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "eval/test_program.h"
#ifdef GLOVEBENCH_DDS
#include "core/base/angles.h"
#include "core/robot/arm_follower.h"
#include "core/robot/command_guard.h"
#include "core/robot/server/command_messages.h"
#include "eval/dds_test_bus.h"
#endif

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

#ifdef GLOVEBENCH_DDS

constexpr double kRounded = 3e-6;      // degrees: two angles of a log
constexpr double kLongestStepS = 0.1;  // what the guard takes as the time of one step, at most

class RobotServer : public DdsBus {
 protected:
  StartedProgram serve(const std::string& side, const std::string& log, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {GLOVEBENCH_PROGRAM, "robot-server", side, "--robot",
                                        "dds:" + domain_,   "--log",        log};
    command.insert(command.end(), more.begin(), more.end());
    return start(command);
  }
  /// A server that has begun, as its log shows.
  StartedProgram serve_until_ready(const std::string& side, const std::string& log,
                                   const std::vector<std::string>& more = {}) {
    const size_t before = std::filesystem::exists(log) ? std::filesystem::file_size(log) : 0;
    const StartedProgram server = serve(side, log, more);
    EXPECT_TRUE(
        comes_true([&] { return std::filesystem::exists(log) && std::filesystem::file_size(log) > before; }));
    return server;
  }

  static std::string joints(const std::vector<std::string>& names, double angle_deg) {
    std::string text;
    for (const std::string& name : names) text += fmt::format(" {}={}", name, radians_from_degrees(angle_deg));
    return text + "\n";
  }
  static std::string fingers(double angle_deg, int sec, int points = 1) {
    return fmt::format("hand {} 0 {}", sec, points) + joints(hand_trajectory_names(), angle_deg);
  }
  static std::string wrist(double angle_deg, int sec) {
    return fmt::format("wrist {} 0 1", sec) + joints(wrist_trajectory_names(), angle_deg);
  }

  static std::vector<json> lines(const std::string& log, const std::string& event) {
    std::vector<json> found;
    std::istringstream all(read_file(log));
    for (std::string line; std::getline(all, line);) {
      json parsed = json::parse(line, nullptr, false);  // a kill may have cut one
      if (!parsed.is_discarded() && parsed.at("event") == event) found.push_back(std::move(parsed));
    }
    return found;
  }
  static int64_t received(const std::string& log, const std::string& topic, const std::string& receipt) {
    const std::vector<json> all = lines(log, "received");
    return std::ranges::count_if(
        all, [&](const json& line) { return line.at("topic") == topic && line.at("receipt") == receipt; });
  }
  static double last_angle(const std::string& log, const std::string& joint) {
    return lines(log, "state").back().at("position_deg").at(joint).get<double>();
  }
  /// rad/s: what the guard grants a joint of the hand, or the arm's own.
  static double speed(const std::string& joint) {
    for (const ArmJointInfo& info : arm_joint_infos())
      if (info.name == joint) return radians_from_degrees(info.max_speed_deg_s);
    return CommandLimits().hand_joint_speed;
  }
  /// From one state to the next no joint moves farther than its speed allows, also not across a restart.
  static void expect_safe(const std::string& log) {
    const std::vector<json> states = lines(log, "state");
    ASSERT_GE(states.size(), 2U);
    for (size_t i = 1; i < states.size(); ++i) {
      const auto clock_us = [&](size_t at) { return states[at].at("clock_us").get<int64_t>(); };
      ASSERT_GT(clock_us(i), clock_us(i - 1));
      const double seconds = std::min(1e-6 * static_cast<double>(clock_us(i) - clock_us(i - 1)), kLongestStepS);
      for (const auto& [name, angle] : states[i].at("position_deg").items()) {
        const double way_deg =
            std::abs(angle.get<double>() - states[i - 1].at("position_deg").at(name).get<double>());
        ASSERT_LE(way_deg, degrees_from_radians(speed(name) * seconds) + kRounded) << name << " in state " << i;
      }
    }
  }
};

class RobotServerLong : public RobotServer {};

TEST_F(RobotServer, FollowsAStreamSaysWhereTheJointsAreAndEndsCleanly) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log), listener = listen();
  finish(talk("wait hand\nwait wrist\n" + wrist(-5, 1) + fingers(10, 1) + "again 60 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, AllOf(HasSubstr("hand: messages: 62 accepted; streams: 1;"), HasSubstr("the longest gap")));
  EXPECT_EQ(received(log, "fingers", "accepted"), 61);
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 10, 1e-6);
  EXPECT_NEAR(last_angle(log, "rh_WRJ1"), -5, 1e-6);
  expect_safe(log);

  const std::vector<std::string> states = lines_of("states", finish(listener).out);
  ASSERT_GT(states.size(), 50U);
  EXPECT_THAT(states.back(), HasSubstr(fmt::format(" rh_FFJ3={:.4f}", radians_from_degrees(10)).substr(0, 14)));
  for (const std::string& name : hand_joint_names()) EXPECT_THAT(states.back(), HasSubstr(" " + name + "="));
}

TEST_F(RobotServer, RefusesWhatIsWrongAndGoesOn) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  std::string other_names = fingers(20, 12);
  other_names.replace(other_names.find("rh_FFJ1"), 7, "xx_FFJ1");
  finish(talk("wait hand\nwait wrist\n" + fingers(5, 10) +                       // good
              fingers(20, 9) + fingers(20, 10) +                                 // went back, came twice
              fingers(std::nan(""), 11) + fingers(INFINITY, 11) + other_names +  // 2 not finite, wrong joints
              "hand 13 0 1" + joints(hand_joint_names(), 20) +                   // with the wrist: wrong joints
              "hand 13 0 1 rh_FFJ1=1\nhand 13 0 1 \n" +                          // one, none: wrong joints
              fingers(20, 14, 0) + fingers(20, 14, 2) +                          // no point, two
              "short 14 0" + joints(hand_trajectory_names(), 20) +               // one position too few
              "hand -1 0 1" + joints(hand_trajectory_names(), 20) +              // before 1970
              "hand 15 4000000000 1" + joints(hand_trajectory_names(), 20) +     // nanoseconds of four seconds
              fingers(1e9, 16) + fingers(10, 17) + "sleep 50\n"));               // clamped; good
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("messages: 3 accepted, 4 wrong_joints, 3 wrong_points, 2 not_finite, 2 bad_time, "
                                 "2 went_back; streams: 1;"));
  EXPECT_LE(last_angle(log, "rh_FFJ3"), 90);
  expect_safe(log);
}

TEST_F(RobotServer, TheFirstSenderOwnsItWhileAnotherFloods) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram owner = talk("wait hand\n" + fingers(10, 1) + "again 300 10000\n");
  ASSERT_TRUE(comes_true([&] { return received(log, "fingers", "accepted") > 0; }));
  const StartedProgram flooder = talk("wait hand\n" + fingers(80, 1) + "again 30000 0\n");
  EXPECT_EQ(finish(owner).out, "said\n");
  EXPECT_EQ(finish(flooder).out, "said\n");
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(received(log, "fingers", "accepted"), 301) << "of the owner's none is lost: " << run.out;
  EXPECT_THAT(run.out, AllOf(HasSubstr(" foreign"), HasSubstr("streams: 1;")));
  EXPECT_LE(last_angle(log, "rh_FFJ3"), 10 + 1e-6);
  expect_safe(log);
}

TEST_F(RobotServer, AFloodOfItsOwnerMovesNothingFaster) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  finish(talk("wait hand\n" + fingers(10, 1) + "again 10000 0\n" + fingers(80, 2) + "again 10000 0\n"));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  EXPECT_LT(lines(log, "received").size(), 6000U) << "it does not fill the disk";
  expect_safe(log);
}

TEST_F(RobotServer, HoldsAndStopsWhenItsSenderDiesAndFollowsTheNext) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram first = talk("wait hand\n" + fingers(10, 1000) + "again 10000 10000\n");
  ASSERT_TRUE(comes_true([&] { return received(log, "fingers", "accepted") > 20; }));
  stop(first, SIGKILL);
  const auto state_is = [&](const char* state) { return lines(log, "state").back().at("state") == state; };
  EXPECT_TRUE(comes_true([&] { return state_is("stopped"); }));
  const std::vector<json> states = lines(log, "state");
  EXPECT_TRUE(std::ranges::any_of(states, [](const json& line) { return line.at("state") == "holding"; }));
  finish(talk("wait hand\n" + fingers(20, 1) + "again 50 10000\n"));  // its stamps begin anew
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_THAT(run.out, HasSubstr("streams: 2;"));
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 20, 1e-6);
  expect_safe(log);
}

TEST_F(RobotServerLong, GoesOnWhereItWasKilled) {
  const std::string log = path("hand.jsonl");
  StartedProgram server = serve_until_ready("hand", log);
  std::string script = "wait hand\n";  // to and fro, so that it is always on its way
  for (int i = 0; i < 40; ++i) script += fingers(i % 2 ? 80 : 5, 1 + i) + "again 20 10000\n";
  const StartedProgram sender = talk(script);
  for (int round = 0; round < 3; ++round) {
    const int64_t before = received(log, "fingers", "accepted");
    ASSERT_TRUE(comes_true([&] { return received(log, "fingers", "accepted") > before + 40; }));
    stop(server, SIGKILL);
    server = serve_until_ready("hand", log);
  }
  EXPECT_EQ(finish(sender).out, "said\n") << "the stream goes on";
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("streams: 1;"));
  expect_safe(log);
}

TEST_F(RobotServer, AFullDiskStopsNoRobot) {
  const StartedProgram listener = listen();
  const StartedProgram server = serve("hand", "/dev/full");
  ASSERT_TRUE(comes_true([&] { return !lines_of("states", said(listener)).empty(); }));
  finish(talk("wait hand\n" + fingers(10, 1) + "again 60 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.out, AllOf(HasSubstr("61 accepted"), HasSubstr("lines lost (No space left on device)")));
  EXPECT_THAT(run.err, HasSubstr("/dev/full: lines: found"));
  const std::vector<std::string> states = lines_of("states", finish(listener).out);
  ASSERT_FALSE(states.empty());
  EXPECT_THAT(states.back(), HasSubstr(" rh_FFJ3=0.1745")) << "it still did what it was told";
}

/// The most memory that a process has had, bytes.
size_t peak_memory(const StartedProgram& program) {
  const std::string status = read_file(fmt::format("/proc/{}/status", program.process));
  return std::stoull(status.substr(status.find("VmHWM:") + 6)) * 1024;
}

TEST_F(RobotServer, AFloodOfHugeMessagesTakesNoMemory) {
  constexpr size_t kMegabyte = 1'000'000;
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const size_t before = peak_memory(server);
  EXPECT_EQ(finish(talk("wait hand\nhuge names 2 100000000\nhuge points 2 50000000\nhuge names 500 15000\n" +
                        fingers(10, 1) + "again 60 10000\n"))
                .out,
            "said\n");
  EXPECT_LT(peak_memory(server), before + 90 * kMegabyte) << "a message alone would be more";
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("hand: messages: 61 accepted, "), HasSubstr("; too large: ")));
  EXPECT_LE(std::ranges::count(run.err, '\n'), 100) << run.err;
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 10, 1e-6);
}

TEST_F(RobotServer, OneServesAHandAndALog) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const ProgramRun same_log = finish(serve("hand", log));
  EXPECT_EQ(same_log.exit_code, 2);
  EXPECT_EQ(same_log.err, "glovebench: " + log +
                              ": log: found another server that is writing it, expected a log of its own for each "
                              "server\n");
  const ProgramRun same_hand = finish(serve("hand", path("other.jsonl")));
  EXPECT_EQ(same_hand.exit_code, 2);
  EXPECT_THAT(same_hand.err, HasSubstr("another process that tells of rh_"));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  const StartedProgram next = serve_until_ready("hand", log);
  const ProgramRun run = stop(next, SIGTERM);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("glovebench: " + log + ": starts at its last state, of 20"));
}

TEST_F(RobotServer, BelievesALogForAsLongAsItIsTold) {
  const std::string log = path("hand.jsonl");
  stop(serve_until_ready("hand", log), SIGTERM);
  ProgramRun run = finish(serve("hand", log, {"--log-age", "0"}));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("hand.jsonl: last state: found one of 20"), HasSubstr(" s ago, expected"),
                             HasSubstr("--log-age")));
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1);
  for (const char* wrong : {"-1", "x", "inf"})
    EXPECT_EQ(finish(serve("hand", log, {"--log-age", wrong})).exit_code, 2);
}

TEST_F(RobotServer, RefusesLogsOfOthers) {
  write_file(path("letter"), "Dear robot,\n");
  ProgramRun run = finish(serve("hand", path("letter")));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("letter: lines: found none of a log of `robot-server`"));
  EXPECT_EQ(read_file(path("letter")), "Dear robot,\n");
  run = finish(serve("hand", "/nowhere/log"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("/nowhere/log: file: found No such file"));
  run = finish(serve("foot", path("log")));
  EXPECT_EQ(run.exit_code, 2);
}

#ifdef GLOVEBENCH_ARM

/// Where the wrist is when the arm is at rest.
Eigen::Isometry3d wrist_at_rest(const Eigen::Isometry3d& T_flange_wrist = default_T_flange_wrist()) {
  return arm_flange_pose(kArmAtRest) * T_flange_wrist;
}

/// A pose that far from there, as a line for the probe.
std::string pose(const Eigen::Vector3d& way, int sec, const std::string& frame = "base_link",
                 const Eigen::Isometry3d& T_flange_wrist = default_T_flange_wrist()) {
  const Eigen::Isometry3d T = wrist_at_rest(T_flange_wrist);
  const Eigen::Vector3d p = T.translation() + way;
  const Eigen::Quaterniond q(T.linear());
  return fmt::format("pose {} 0 {} {} {} {} {} {} {} {}\n", sec, frame, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(),
                     q.w());
}

/// Where the wrist is at the end of a log.
Eigen::Vector3d last_wrist(const json& state, const Eigen::Isometry3d& T_flange_wrist = default_T_flange_wrist()) {
  ArmJoints joints;
  for (int j = 0; j < kArmJointCount; ++j)
    joints[j] =
        radians_from_degrees(state.at("position_deg").at(std::string(arm_joint_infos()[j].name)).get<double>());
  return (arm_flange_pose(joints) * T_flange_wrist).translation();
}

TEST_F(RobotServer, TheArmTakesTheWristWhereItShallGo) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server = serve_until_ready("arm", log);
  const Eigen::Vector3d way(-0.05, 0.08, -0.03);
  finish(talk("wait pose\n" + pose(way, 1) + "again 60 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("arm: messages: 61 accepted; streams: 1;"));
  const Eigen::Vector3d wrist = last_wrist(lines(log, "state").back());
  EXPECT_LT((wrist - wrist_at_rest().translation() - way).norm(), 1e-4) << wrist.transpose();
  expect_safe(log);
}

TEST_F(RobotServer, TheArmKnowsHowTheHandIsMounted) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server =
      serve_until_ready("arm", log, {"--flange-wrist", "0", "0", "0.1", "0.6", "0", "0", "0.8"});
  const Eigen::Isometry3d mounted = Eigen::Translation3d(0, 0, 0.1) * Eigen::Quaterniond(0.6, 0, 0, 0.8);
  const Eigen::Vector3d way(-0.05, 0.08, -0.03);
  finish(talk("wait pose\n" + pose(way, 1, "base_link", mounted) + "again 60 10000\n"));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  const Eigen::Vector3d wrist = last_wrist(lines(log, "state").back(), mounted);
  EXPECT_LT((wrist - wrist_at_rest(mounted).translation() - way).norm(), 1e-4) << wrist.transpose();
  expect_safe(log);

  const auto refusal = [&](const std::string& side, const std::vector<std::string>& numbers) {
    std::vector<std::string> more = {"--flange-wrist"};
    more.insert(more.end(), numbers.begin(), numbers.end());
    const ProgramRun run = finish(serve(side, path("other.jsonl"), more));
    EXPECT_EQ(run.exit_code, 2);
    return run.err;
  };
  EXPECT_THAT(refusal("arm", {"0", "0", "0", "1", "1", "0", "0"}),
              HasSubstr("--flange-wrist: length of the quaternion"));
  EXPECT_THAT(refusal("arm", {"nan", "0", "0", "1", "0", "0", "0"}),
              HasSubstr("--flange-wrist: transform: found nan"));
  refusal("arm", {"0", "0", "0.1"});
  refusal("hand", {"0", "0", "0.1", "1", "0", "0", "0"});
}

TEST_F(RobotServer, TheArmStartsAtALimitAndNotBeyond) {
  const std::string log = path("arm.jsonl");
  stop(serve_until_ready("arm", log), SIGTERM);
  const std::string last = lines(log, "state").back().dump();
  const auto log_at = [&](double angle_deg) {
    json state = json::parse(last);
    state["position_deg"]["S1"] = angle_deg;
    state["time_us"] =
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    std::string text = state.dump();  // in the order of a log: `event` comes first
    text.erase(text.find(R"("event":"state",)"), 16);
    write_file(log, R"({"event":"state",)" + text.substr(1) + "\n");
  };
  log_at(177);
  ProgramRun run = stop(serve_until_ready("arm", log), SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(last_angle(log, "S1"), 177);
  log_at(177.5);
  run = finish(serve("arm", log));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.err.substr(run.err.rfind("glovebench: ")),
            "glovebench: " + log + ": S1: found 177.5 degrees, expected -177 to 177\n");
}

TEST_F(RobotServerLong, TheArmRefusesWhatIsWrongAndStaysWhereItCannotGo) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server = serve_until_ready("arm", log);
  finish(talk("wait pose\n" + pose({0, 0, 0}, 10) + pose({0, 0.1, 0}, 11, "world") +
              pose({0, std::nan(""), 0}, 11) + pose({0, 0.1, 0}, 9) + "pose 12 0 base_link 0.5 0 0.5 0 0 0 2\n" +
              pose({50, 0, 0}, 20) + "again 600 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("messages: 602 accepted, 1 not_finite, 1 not_rotation, 1 wrong_frame, 1 went_back;"),
                    HasSubstr(" arm_unreachable"), HasSubstr(" workspace")));
  expect_safe(log);
}

TEST_F(RobotServerLong, HandAndArmGoOnWhereTheyWereKilledWhileTheStreamGoesOn) {
  const std::string hand_log = path("hand.jsonl"), arm_log = path("arm.jsonl");
  StartedProgram hand = serve_until_ready("hand", hand_log), arm = serve_until_ready("arm", arm_log);
  std::string script = "wait hand\nwait pose\n";
  for (int i = 0; i < 600; ++i) {
    const bool there = i / 40 % 2 == 1;
    script += fingers(there ? 80 : 5, 1 + i) + pose({0, there ? 0.2 : 0, 0}, 1 + i) + "sleep 10\n";
  }
  const StartedProgram sender = talk(script);
  for (int round = 0; round < 2; ++round) {
    const auto sent = [&] {
      return received(hand_log, "fingers", "accepted") + received(arm_log, "pose", "accepted");
    };
    const int64_t before = sent();
    ASSERT_TRUE(comes_true([&] { return sent() > before + 100; }));
    stop(hand, SIGKILL);
    stop(arm, SIGKILL);
    hand = serve_until_ready("hand", hand_log);
    arm = serve_until_ready("arm", arm_log);
  }
  EXPECT_EQ(finish(sender).out, "said\n") << "the stream goes on";
  for (const StartedProgram& server : {hand, arm}) {
    const ProgramRun run = stop(server, SIGTERM);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("streams: 1;"));
  }
  expect_safe(hand_log);
  expect_safe(arm_log);
}

#else

TEST_F(RobotServer, TheArmIsNamedWhereTheBuildLacksIt) {
  const ProgramRun run = finish(serve("arm", path("arm.jsonl")));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("without Orocos KDL"), HasSubstr("liborocos-kdl-dev")));
}

#endif

#endif

}  // namespace
}  // namespace glovebench::eval
