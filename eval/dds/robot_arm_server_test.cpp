// A server of the arm as a process, and one of hand and arm.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/adapters/kdl/make_arm_solver.h"
#include "core/adapters/system_time.h"
#include "core/robot/test_fingertips.h"
#include "eval/dds/robot_server_fixture.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// The wrist's pose with the arm at rest.
Eigen::Isometry3d wrist_at_rest(const Eigen::Isometry3d& T_flange_wrist = default_T_flange_wrist()) {
  return arm_flange_pose(kArmAtRest) * T_flange_wrist;
}

/// A probe's line for a pose at that distance from there.
std::string pose(const Eigen::Vector3d& way, int sec, const std::string& frame = "base_link",
                 const Eigen::Isometry3d& T_flange_wrist = default_T_flange_wrist()) {
  const Eigen::Isometry3d T = wrist_at_rest(T_flange_wrist);
  const Eigen::Vector3d p = T.translation() + way;
  const Eigen::Quaterniond q(T.linear());
  return fmt::format("pose {} 0 {} {} {} {} {} {} {} {}\n", sec, frame, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(),
                     q.w());
}

/// The wrist's pose at the end of a log.
Eigen::Isometry3d last_wrist(const json& state,
                             const Eigen::Isometry3d& T_flange_wrist = default_T_flange_wrist()) {
  ArmJoints joints;
  for (int j = 0; j < kArmJointCount; ++j)
    joints[j] =
        radians_from_degrees(state.at("position_deg").at(std::string(arm_joint_infos()[j].name)).get<double>());
  return arm_flange_pose(joints) * T_flange_wrist;
}

/// Checks each fingertip's speed in the arm's base frame between the states of a log.
void expect_slow_fingertips(const std::string& log) {
  std::optional<TestFingertips::Tips> last;
  int64_t last_us = 0;
  double fastest = 0;
  std::istringstream all(read_file(log));
  for (std::string line; std::getline(all, line);) {
    const json event = json::parse(line, nullptr, false);  // a kill may have cut it
    if (event.is_discarded() || event.at("event") == "start") last.reset();
    if (event.is_discarded() || event.at("event") != "state") continue;
    std::array<double, kShadowJointCount> joints;
    for (size_t j = 0; j < joints.size(); ++j)
      joints[j] = radians_from_degrees(event.at("position_deg").at(hand_joint_names()[j]).get<double>());
    const Eigen::Isometry3d T_base_wrist = last_wrist(event);
    const TestFingertips::Tips now =
        (T_base_wrist.linear() * TestFingertips(joints).in_forearm()).colwise() + T_base_wrist.translation();
    const auto now_us = event.at("clock_us").get<int64_t>();
    if (last) {
      const double seconds = std::min(CommandLimits().longest_step_s, static_cast<double>(now_us - last_us) * 1e-6);
      const double way = (now - *last).colwise().norm().maxCoeff();
      ASSERT_LE(way, CommandLimits().fingertip_speed * seconds + 1e-7) << line;  // rounding of a log
      fastest = std::max(fastest, way / seconds);
    }
    last = now;
    last_us = now_us;
  }
  EXPECT_GT(fastest, 0.2) << "it has moved";
}

class RobotServerArm : public RobotServer {
 protected:
  void SetUp() override {
    if (!make_arm_solver()) GTEST_SKIP() << "built without Orocos KDL";
    RobotServer::SetUp();
  }
};

TEST_F(RobotServerArm, TheArmTakesTheWristWhereItShallGo) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server = serve_until_ready("arm", log);
  const Eigen::Vector3d way(-0.05, 0.08, -0.03);
  finish(talk("wait pose\n" + pose(way, 1) + "again 200 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(good(log, "pose"), 201);
  EXPECT_THAT(run.out, HasSubstr("arm: messages: "));
  const Eigen::Vector3d wrist = last_wrist(last_line(log, "state")).translation();
  EXPECT_LT((wrist - wrist_at_rest().translation() - way).norm(), 1e-4) << wrist.transpose();
  expect_safe(log);
}

TEST_F(RobotServerArm, TheArmKnowsHowTheHandIsMounted) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server =
      serve_until_ready("arm", log, {"--flange-wrist", "0", "0", "0.1", "0.6", "0", "0", "0.8"});
  const Eigen::Isometry3d mounted = Eigen::Translation3d(0, 0, 0.1) * Eigen::Quaterniond(0.6, 0, 0, 0.8);
  const Eigen::Vector3d way(-0.05, 0.08, -0.03);
  finish(talk("wait pose\n" + pose(way, 1, "base_link", mounted) + "again 200 10000\n"));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  const Eigen::Vector3d wrist = last_wrist(last_line(log, "state"), mounted).translation();
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

TEST_F(RobotServerArm, TheArmStartsAtALimitAndNotBeyond) {
  const std::string log = path("arm.jsonl");
  stop(serve_until_ready("arm", log), SIGTERM);
  const std::string last = last_line(log, "state").dump();
  const auto log_at = [&](double angle_deg) {
    json state = json::parse(last);
    state["position_deg"]["S1"] = angle_deg;
    state["time_us"] = system_us();
    std::string text = state.dump();  // in the log's order, which starts with `event`
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

TEST_F(RobotServerArm, TheArmRefusesWhatIsWrongAndStaysWhereItCannotGo) {
  const std::string log = path("arm.jsonl");
  const StartedProgram server = serve_until_ready("arm", log);
  finish(talk("wait pose\n" + pose({0, 0, 0}, 10) + "again 60 10000\n" + pose({0, 0.1, 0}, 11, "world") +
              pose({0, std::nan(""), 0}, 11) + pose({0, 0.1, 0}, 9) + "pose 12 0 base_link 0.5 0 0.5 0 0 0 2\n" +
              pose({50, 0, 0}, 20) + "again 600 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("arm: messages: 1 wrong_frame, 1 not_finite, 1 not_rotation, "),
                             HasSubstr(" arm_unreachable"), HasSubstr(" workspace")));
  EXPECT_EQ(good(log, "pose") + received(log, "pose", "went_back"), 61 + 1 + 601);
  expect_safe(log);
}

TEST_F(RobotServerArm, HandAndArmGoOnWhereTheyWereKilledWhileTheStreamGoesOn) {
  const std::string log = path("robot.jsonl");
  const SimulatedRobot robot(std::stoi(domain_));
  StartedProgram server = serve_until_ready("hand and arm", log);
  std::string script = "wait hand\nwait pose\n";
  for (int i = 0; i < 600; ++i) {
    const bool there = i / 40 % 2 == 1;
    script += fingers(there ? 80 : 5, 1 + i) + pose({0, there ? 0.2 : 0, 0}, 1 + i) + "sleep 10\n";
  }
  const StartedProgram sender = talk(script);
  const auto sent = [&] { return std::min(good(log, "fingers"), good(log, "pose")); };
  for (int round = 0; round < 2; ++round) {
    const int64_t before = sent();
    ASSERT_TRUE(comes_true([&] { return sent() > before + 50; }));
    stop(server, SIGKILL);
    server = serve_until_ready("hand and arm", log);
  }
  EXPECT_EQ(finish(sender).out, "said\n") << "the stream goes on";
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("hand and arm: messages: "));
  if (!had_gaps(run)) {
    EXPECT_THAT(run.out, HasSubstr("streams: 1;"));
  }
  expect_safe(log);
  expect_slow_fingertips(log);
}

TEST_F(RobotServerArm, OneServesAHandAndAnArm) {
  const StartedProgram server = serve_until_ready("hand and arm", path("robot.jsonl"));
  for (const std::string side : {"hand", "arm"}) {
    const ProgramRun run = finish(serve(side, path(side)));
    EXPECT_EQ(run.exit_code, 2) << side;
    EXPECT_THAT(run.err, HasSubstr("another process that tells of "));
  }
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  const ProgramRun run = finish(serve("hand", path("robot.jsonl")));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("robot.jsonl: last state: found 31 joints, expected the 24 joints"));
}

}  // namespace
}  // namespace glovebench::eval
