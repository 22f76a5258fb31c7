// Trackers that are programs of their own.
#include <gmock/gmock.h>

#include <set>

#include "ci/build_paths.h"
#include "eval/command_test.h"
#include "eval/program.h"
#include "eval/run.h"
#include "eval/streaming.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Programs : public CommandTest {
 protected:
  /// A tracker in Python that answers with `answer`, an expression of the frame's line `frame`.
  /// It takes `start_s` to start.
  std::string program(const std::string& answer, double start_s = 0) const {
    write_file(path("mine.py"), fmt::format(R"(
import json, sys, time
open("{}", "a").write("started\n")
time.sleep({})
frames = sys.stdin.buffer
start = json.loads(frames.readline())
while line := frames.readline():
    frame = json.loads(line)
    frames.read(frame["depth_bytes"] + frame["rgb_bytes"])
    print(json.dumps({}), flush=True)
)",
                                            path("starts"), start_s, answer));
    return "exec:/usr/bin/python3 '" + path("mine.py") + "'";
  }
  size_t starts() const {
    const std::string lines = std::filesystem::exists(path("starts")) ? read_file(path("starts")) : "";
    return static_cast<size_t>(std::ranges::count(lines, '\n'));
  }
  /// Exit code, stdout and stderr of `method test`.
  ProgramRun test(const std::string& answer) const { return run_glovebench({"method", "test", program(answer)}); }
};
using ProgramsLong = Programs;

constexpr const char* kGood =
    R"({"frame": frame["frame"], "position_mm": [0, 0, 700], "quaternion_wxyz": [1, 0, 0, 0], "angles_deg": [5] * 22})";

/// The metrics of each frame, by frame and key.
std::vector<std::map<std::string, double>> frames_of_run(const json& results) {
  std::vector<std::map<std::string, double>> frames;
  constexpr size_t kFirstMetric = 9;  // after the frame, its status and the like
  const json& columns = results.at("frame_columns");
  for (const json& row : results.at("experiments").at(0).at("runs").at(0).at("frames")) {
    frames.emplace_back();
    for (size_t c = kFirstMetric; c < columns.size(); ++c)
      if (row.at(c).is_number()) frames.back()[columns.at(c)] = row.at(c);
  }
  return frames;
}

TEST_F(ProgramsLong, OurTrackerAsAProgramEqualsItself) {
  Workbench workbench(test_workbench());
  workbench.database("DB_open_power")->save(path("open_power.glovedb"));
  workbench.color_table()->save(path("colors.table"));
  const std::string program = fmt::format("exec:'{}' '{}' '{}' '{}'", build_paths::program("core_tracker"),
                                          hand_mesh_path(), path("open_power.glovedb"), path("colors.table"));
  const auto run = [&](const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run",           "--trajectory", "Tr4",       "--database",
                                          "DB_open_power", "-o",           path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun ran = run_glovebench(arguments);
    expect_fine(ran);
    return ran.out.substr(0, ran.out.find("All metrics"));
  };
  EXPECT_EQ(run("own", {}), run("program", {"--method", program})) << "the printed tables";
  const json own = json::parse(read_file(path("own/results.json")));
  const json other = json::parse(read_file(path("program/results.json")));
  EXPECT_EQ(other.at("configuration").at("tracker").at("method"), program);
  const auto own_frames = frames_of_run(own), other_frames = frames_of_run(other);
  ASSERT_EQ(own_frames.size(), 117U);
  ASSERT_EQ(other_frames.size(), 117U);
  std::set<std::string> missing;
  for (size_t f = 0; f < own_frames.size(); ++f) {
    for (const auto& [key, value] : own_frames[f]) {
      const auto found = other_frames[f].find(key);
      if (found == other_frames[f].end())
        missing.insert(key);
      else
        EXPECT_NEAR(found->second, value, 1e-4) << "frame " << f << " " << key;
    }
  }
  EXPECT_THAT(missing, ElementsAre("icp_residual_mm", "matching_error_px", "posture_rms_unfiltered_deg"));
}

TEST_F(ProgramsLong, MethodTestSaysWhatIsWrong) {
  const ProgramRun good = test(kGood);
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, AllOf(HasSubstr("10 of 10 frames tracked"), HasSubstr("angles, pose")));
  const auto expect_fault = [&](const std::string& answer, const std::string& fault) {
    const ProgramRun bad = test(answer);
    EXPECT_EQ(bad.exit_code, 1) << answer;
    std::string text = bad.out;  // without its line breaks
    while (text.find("\n  ") != std::string::npos) text.erase(text.find("\n  "), 2);
    std::ranges::replace(text, '\n', ' ');
    EXPECT_THAT(text, HasSubstr(fault));
  };
  const auto changed = [](std::string from, const std::string& to) {
    std::string answer = kGood;
    return answer.replace(answer.find(from), from.size(), to);
  };
  expect_fault(changed("700", "0.7"), "look like meters");
  expect_fault(changed("[5] * 22", "[0.5] * 22"), "look like radians");
  expect_fault(changed("[5] * 22", "[160] * 22"), "wrist_flexion: found 160.0 to 160.0 degrees");
  expect_fault(R"({"frame": frame["frame"], "joints_mm": [None] * 25})", "joints_mm: found only null");
  expect_fault(changed("[5] * 22", "[5] * 21"), "angles_deg: found");
  expect_fault(changed("[1, 0, 0, 0]", "[1, 1, 0, 0]"), "quaternion");
  expect_fault(changed("frame[\"frame\"]", "0"), "an answer to another frame");
  expect_fault(R"({"frame": frame["frame"], "joints_mm": [[0, 0, 700]] * 21})", "joints_mm: found");
  expect_fault(R"({"frame": frame["frame"], "status": "no_hand"})", "no frame was tracked");
}

TEST_F(Programs, ComeFromTheCommandLineAlone) {
  write_file(path("config.json"), json{{"method", "exec:touch '" + path("touched") + "'"}}.dump());
  const std::string message =
      refusal(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "--config",
                              path("config.json"), "-o", path("out")}));
  EXPECT_THAT(message, AllOf(HasSubstr("config.json: method: found \"exec:touch"), HasSubstr("--method")));
  EXPECT_FALSE(std::filesystem::exists(path("touched")));
}

TEST_F(ProgramsLong, ExplainStartsNone) {
  const json results = run_trajectory("good.json", "out", {"--method", program(kGood)});
  EXPECT_EQ(starts(), 1U);
  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "1", "--trajectory", path("good.json")})),
              AllOf(HasSubstr("method: found \"exec:"), HasSubstr("--method")));
  EXPECT_EQ(starts(), 1U);
}

TEST_F(ProgramsLong, LostFramesAreCountedWithTheirReasons) {
  const ProgramRun run =
      run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o", path("out"),
                      "--method", program("1 / (frame['frame'] != 1) and " + std::string(kGood)) + " 2>/dev/null"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(starts(), 2U);
  EXPECT_THAT(run.err, HasSubstr("warning: 1 frame lost, no answer: the program ended with exit code 1"));
  EXPECT_THAT(read_file(path("out/index.html")), HasSubstr("the program ended with exit code 1"));
  EXPECT_THAT(read_file(path("out/results.json")), HasSubstr("\"missing\""));
}

TEST_F(ProgramsLong, HaveNoTimeWithoutAnAnswer) {
  const ProgramRun run = run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power",
                                         "-o", path("out"), "--streaming", "--method", "exec:false"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json timings = json::parse(read_file(path("out/timings.json")));
  EXPECT_TRUE(cell_of(timings, kStreamingStudy, "tracker_ms").is_null());
  EXPECT_TRUE(cell_of(timings, kStreamingStudy, "age_ms").is_null());
}

TEST_F(ProgramsLong, JointsAloneAreMeasured) {
  const json results = run_trajectory(
      "good.json", "out",
      {"--method", program(R"({"frame": frame["frame"], "joints_mm": [[0, 20, 700]] * 24 + [None]})")});
  const auto frames = frames_of_run(results);
  EXPECT_TRUE(frames.at(0).contains("joint_error_mm")) << results.at("frame_columns");
  EXPECT_FALSE(frames.at(0).contains("position_error_mm"));
}

TEST_F(ProgramsLong, StandBesideOursInAReproduction) {
  const auto reproduce = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"reproduce", "--quick", "--only", "external", "-q", "-o", path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  EXPECT_THAT(refusal(reproduce({})), HasSubstr("expected exec:COMMAND"));
  constexpr double kStart_s = 2;  // twice the frames' time
  expect_fine(
      reproduce({"--method", program(R"({"frame": frame["frame"], "joints_mm": [[0, 20, 700]] * 25})", kStart_s)}));
  const json tables = json::parse(read_file(path("out/results.json"))).at("studies").at(0).at("tables");
  for (const json& table : tables) {
    std::vector<std::string> trackers;
    for (const json& row : table.at("rows")) trackers.push_back(row.at(0));
    EXPECT_THAT(trackers, ElementsAre("paper", "recommended", "the program", "the program, bare hand"));
  }
  EXPECT_EQ(tables.at(1).at("name"), "streaming");
  EXPECT_LT(cell_of(json::parse(read_file(path("out/timings.json"))), "external", "dropped_percent", 2), 50)
      << "the start is not the first frame's time";
  const json& table = tables[0];
  EXPECT_LT(table["rows"][1][2].get<double>(), 20) << "our joints";
  EXPECT_GT(table["rows"][2][2].get<double>(), 30) << "joints that are all one";
}

TEST_F(ProgramsLong, FinishedRunsAreLoadedUnlessTheProgramChanged) {
  Workbench workbench(test_workbench());
  trajectories::Trajectory truth = trajectories::source_trajectory(trajectory_folder(), "Tr4");
  truth.frames.resize(2);
  RunSpec spec{.trajectory = std::make_shared<const trajectories::Trajectory>(std::move(truth)),
               .database = "DB_open_power"};
  spec.tracker.method = program(kGood);
  const auto run = [&] {
    RunStore store(path("out"));
    return execute(workbench, {&spec, 1}, {1, &store}).front();
  };
  const eval::Run first = run(), again = run();
  EXPECT_EQ(starts(), 1U) << "the second is loaded";
  EXPECT_EQ(again.answers.at(1).has.internals, false);
  EXPECT_EQ(again.answers.at(1).posture, first.answers.at(1).posture);
  program(std::string(kGood) + " or 1");  // another file of the same name
  run();
  EXPECT_EQ(starts(), 2U);
}

TEST_F(ProgramsLong, StandBesideOthersInATable) {
  const ProgramRun run =
      run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o", path("out"),
                      "--method", program(kGood), "--method", "schroeder2012"});
  expect_fine(run);
  EXPECT_THAT(run.out, AllOf(HasSubstr("exec-"), HasSubstr("mine.py")));
}

}  // namespace
}  // namespace glovebench::eval
