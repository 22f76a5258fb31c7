// Limits of robot commands, from the command line to commands and reports.
#include "eval/command_test.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class RobotLimits : public CommandTest {};

TEST_F(RobotLimits, SlowTheHandDownAndStandInTheResults) {
  write_file(path("slow.json"), R"({"hand_speed_m_s": 0.001})");
  const json free = run_trajectory("good.json", "free", {"--robot-out", path("free_robot")});
  const json slow =
      run_trajectory("good.json", "slow", {"--robot-limits", path("slow.json"), "--robot-out", path("slow_robot")});
  const auto interventions = [](const json& results) {
    return results["experiments"][0]["commands"]["interventions"].value("hand_speed", 0);
  };
  EXPECT_EQ(interventions(free), 0);
  EXPECT_EQ(interventions(slow), kFrames - 1) << "all but the first";
  EXPECT_EQ(free["configuration"]["robot"]["limits"]["hand_speed_m_s"], 0.25);
  EXPECT_EQ(free["configuration"]["robot"]["limits"]["fingertip_speed_m_s"], 0.5);
  EXPECT_EQ(free["configuration"]["robot"]["mapping"], "direct");
  EXPECT_EQ(free["configuration"]["robot"]["coupling"], "series");
  EXPECT_EQ(slow["configuration"]["robot"]["limits"]["hand_speed_m_s"], 0.001);
  EXPECT_EQ(slow["configuration"]["robot"]["limits"]["stop_after_s"], 0.5) << "also what was not changed";
  EXPECT_FALSE(read_folder(path("free_robot")) == read_folder(path("slow_robot")));

  render_recording("good.json", "dump");
  expect_fine(track("dump", "DB_open_power", "estimates.jsonl",
                    {"--robot-limits", path("slow.json"), "--robot-out", path("tracked.jsonl")}));
  EXPECT_EQ(read_file(path("tracked.jsonl")), read_folder(path("slow_robot")).begin()->second);
}

TEST_F(RobotLimits, TheCouplingSplitsWhatTheMotorsGet) {
  const auto first_line = [&](const std::string& name) {
    const std::string text = read_folder(path(name + "_robot")).begin()->second;
    return json::parse(text.substr(0, text.find('\n')));
  };
  for (const std::string coupling : {"series", "even"}) {
    const json results = run_trajectory("good.json", coupling,
                                        {"--robot-coupling", coupling, "--robot-out", path(coupling + "_robot")});
    EXPECT_EQ(results["configuration"]["robot"]["coupling"], coupling);
  }
  const json series = first_line("series"), even = first_line("even");
  EXPECT_EQ(series["actuators"], even["actuators"]);
  const double motor = even["actuators"]["target_deg"]["FFJ0"];
  EXPECT_GT(motor, 0);
  EXPECT_NEAR(even["joints"]["target_deg"]["FFJ1"].get<double>(), motor / 2, 1e-5);
  EXPECT_NEAR(series["joints"]["target_deg"]["FFJ1"].get<double>(), std::max(0.0, motor - 90), 1e-5);
  EXPECT_THAT(refusal(run_glovebench({"list", "mapping", "--robot-coupling", "both"})),
              HasSubstr("--robot-coupling"));
}

TEST_F(RobotLimits, ListedOnesAreTheDefaults) {
  const ProgramRun listed = run_glovebench({"list", "limits"});
  expect_fine(listed);
  write_file(path("limits.json"), listed.out);
  const json results = run_trajectory("good.json", "out");
  EXPECT_EQ(run_trajectory("good.json", "same", {"--robot-limits", path("limits.json")})["experiments"],
            results["experiments"]);
}

TEST_F(RobotLimits, ThatCannotBeAreRefused) {
  const auto refused = [&](const std::string& limits) {
    write_file(path("limits.json"), limits);
    return refusal(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o",
                                   path("out"), "--robot-limits", path("limits.json")}));
  };
  EXPECT_THAT(refused("{"), HasSubstr("limits.json: column 2: found the end of the text, expected JSON"));
  EXPECT_THAT(refused(R"({"hand_speed_m_s": -1})"), AllOf(HasSubstr("limits.json"), HasSubstr("hand_speed")));
  EXPECT_THAT(refused(R"({"speed": 1})"), HasSubstr("unknown key \"speed\""));
  EXPECT_THAT(refused(R"({"workspace_max_m": [1, 1, 0.2]})"),
              HasSubstr("a side of the workspace is shorter than 0.3 m"));
  EXPECT_THAT(refused(R"({"silence_s": 0.1, "silence_s": 0.2})"), HasSubstr("silence_s: found the key twice"));
  EXPECT_FALSE(std::filesystem::exists(path("out/results.json")));
}

}  // namespace
}  // namespace glovebench::eval
