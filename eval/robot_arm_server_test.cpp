// The arm's server as a process, by itself and beside the hand's.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "eval/test_program.h"
#ifdef GLOVEBENCH_DDS
#include "core/base/system_time.h"
#include "eval/robot_server_fixture.h"
#endif

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

#ifdef GLOVEBENCH_DDS
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
  finish(talk("wait pose\n" + pose(way, 1) + "again 200 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(good(log, "pose"), 201);
  EXPECT_THAT(run.out, HasSubstr("arm: messages: "));
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
  finish(talk("wait pose\n" + pose(way, 1, "base_link", mounted) + "again 200 10000\n"));
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
    state["time_us"] = system_us();
    std::string text = state.dump();  // in the order of a log: `event` comes first
    text.erase(text.find(R"("event":"state",)"), 16);
    const std::string place = state["position_deg"].dump();
    write_file(log, R"({"event":"state",)" + text.substr(1) + "\n" +
                        fmt::format(R"({{"event":"interval","time_us":1,"min_deg":{0},"max_deg":{0}}})", place) +
                        "\n");
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

TEST_F(RobotServer, TheArmRefusesWhatIsWrongAndStaysWhereItCannotGo) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server = serve_until_ready("arm", log);
  finish(talk("wait pose\n" + pose({0, 0, 0}, 10) + "again 60 10000\n" + pose({0, 0.1, 0}, 11, "world") +
              pose({0, std::nan(""), 0}, 11) + pose({0, 0.1, 0}, 9) + "pose 12 0 base_link 0.5 0 0.5 0 0 0 2\n" +
              pose({50, 0, 0}, 20) + "again 600 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr(" accepted, 1 not_finite, 1 not_rotation, 1 wrong_frame, "),
                             HasSubstr(" arm_unreachable"), HasSubstr(" workspace")));
  EXPECT_EQ(good(log, "pose") + received(log, "pose", "went_back"), 61 + 1 + 601);
  expect_safe(log);
}

TEST_F(RobotServer, HandAndArmGoOnWhereTheyWereKilledWhileTheStreamGoesOn) {
  const std::string hand_log = path("hand.jsonl"), arm_log = path("arm.jsonl");
  const SimulatedRobot robot(std::stoi(domain_));
  StartedProgram hand = serve_until_ready("hand", hand_log), arm = serve_until_ready("arm", arm_log);
  std::string script = "wait hand\nwait pose\n";
  for (int i = 0; i < 600; ++i) {
    const bool there = i / 40 % 2 == 1;
    script += fingers(there ? 80 : 5, 1 + i) + pose({0, there ? 0.2 : 0, 0}, 1 + i) + "sleep 10\n";
  }
  const StartedProgram sender = talk(script);
  for (int round = 0; round < 2; ++round) {
    const auto sent = [&] { return good(hand_log, "fingers") + good(arm_log, "pose"); };
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
    if (!had_gaps(run)) {
      EXPECT_THAT(run.out, HasSubstr("streams: 1;"));
    }
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
