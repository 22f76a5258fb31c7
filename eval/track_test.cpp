// Tracking of recordings, from the command line to the files.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/file.h"
#include "eval/command_test.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class TrackLong : public CommandTest {};

TEST_F(TrackLong, OfADumpEqualsTheRun) {
  run_trajectory("good.json", "out", {"--robot-out", path("robot")});
  render_recording("good.json", "dump");
  const ProgramRun tracked =
      track("dump", "DB_open_power", "estimates.jsonl", {"--robot-out", path("tracked_robot.jsonl")});
  expect_fine(tracked);
  EXPECT_THAT(tracked.out, HasSubstr("4 of 4 frames tracked"));
  const std::string lines = read_file(path("estimates.jsonl"));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), kFrames);
  const std::map<std::string, std::string> robot = read_folder(path("robot"));
  ASSERT_EQ(robot.size(), 1U);
  EXPECT_EQ(read_file(path("tracked_robot.jsonl")), robot.begin()->second)
      << "the robot commands hold the posture and the pose of each frame";
}

TEST_F(TrackLong, NamesDamagedFilesAndGoesOn) {
  render_recording("good.json", "dump");
  expect_fine(track("dump", "DB_open_power", "whole.jsonl"));
  std::vector<std::string> depths;
  for (const auto& entry : fs::directory_iterator(path("dump")))
    if (entry.path().extension() == ".pgm") depths.push_back(entry.path().string());
  std::sort(depths.begin(), depths.end());
  fs::resize_file(depths[1], 5000);
  fs::remove(depths[2]);
  const ProgramRun run = track("dump", "DB_open_power", "damaged.jsonl");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("2 of 4 frames tracked, 2 unusable\n"));
  EXPECT_THAT(run.err, AllOf(HasSubstr("skipped: " + depths[1] + ": size"), HasSubstr("skipped: " + depths[2])));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
  const std::string lines = read_file(path("damaged.jsonl"));
  const std::string whole = read_file(path("whole.jsonl"));
  EXPECT_EQ(lines.substr(0, lines.find('\n')), whole.substr(0, whole.find('\n')));
  EXPECT_EQ(json::parse(lines.substr(lines.find('\n'))).at("frame"), 3) << "a skipped frame keeps its number";

  for (const std::string& depth : depths) write_file(depth, "");
  EXPECT_THAT(track("dump", "DB_open_power", "none.jsonl").err, HasSubstr("usable frames: found none of 4"));
  EXPECT_FALSE(fs::exists(path("none.jsonl")));
}

TEST_F(TrackLong, FullDiskKeepsTheOlderCommands) {
  render_recording("good.json", "dump");
  write_file(path("robot.jsonl"), "older");
  expect_fine(track("dump", "DB_open_power", "whole.jsonl", {"--robot-out", path("whole_robot.jsonl")}));
  ProgramSetting full;
  full.max_file_bytes = fs::file_size(path("whole_robot.jsonl")) - 100;
  EXPECT_THAT(
      refusal(run_glovebench({"track", "--source", "fakenect:" + path("dump"), "--database", "DB_open_power", "-o",
                              path("estimates.jsonl"), "--robot-out", path("robot.jsonl")},
                             full)),
      HasSubstr("room"));
  EXPECT_EQ(read_file(path("robot.jsonl")), "older") << "not the first half of the new ones";
}

TEST_F(TrackLong, TakesACalibrationOfItsOwn) {
  render_recording("good.json", "dump");
  json calibration = json::parse(read_file(path("dump/calibration.json")));
  fs::remove(path("dump/calibration.json"));  // as fakenect records
  EXPECT_THAT(refusal(track("dump", "DB_open_power", "x.jsonl")), HasSubstr("calibration.json"));
  // The driver's formula once more, 2% farther away.
  calibration["disparity"] = {{"a_per_m", -1 / 345.489 / 1.02}, {"b_per_m", 1089.41 / 345.489 / 1.02}};
  write_file(path("own.json"), calibration.dump());
  expect_fine(track("dump", "DB_open_power", "far.jsonl", {"--calibration", path("own.json")}));
  calibration.erase("disparity");
  write_file(path("own.json"), calibration.dump());
  expect_fine(track("dump", "DB_open_power", "near.jsonl", {"--calibration", path("own.json")}));
  const auto first_z_mm = [&](const std::string& name) {
    const std::string lines = read_file(path(name));
    return json::parse(lines.substr(0, lines.find('\n'))).at("position_mm").at(2).get<double>();
  };
  EXPECT_NEAR(first_z_mm("far.jsonl") / first_z_mm("near.jsonl"), 1.02, 0.008) << "700 mm away";
  write_file(path("own.json"), "{}");
  EXPECT_THAT(refusal(track("dump", "DB_open_power", "x.jsonl", {"--calibration", path("own.json")})),
              HasSubstr("own.json"));
}

TEST_F(TrackLong, WithAnotherMethod) {
  const json results = run_trajectory("good.json", "out", {"--method", "monocular_bbox"});
  EXPECT_EQ(results.at("configuration").at("tracker").at("method"), "monocular_bbox");
  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "2", "--trajectory", path("good.json")})),
              AllOf(HasSubstr("monocular_bbox"), HasSubstr("schroeder2012")));
  render_recording("good.json", "dump");
  expect_fine(track("dump", "DB_open_power", "other.jsonl", {"--method", "monocular_bbox"}));
  expect_fine(track("dump", "DB_open_power", "papers.jsonl"));
  EXPECT_THAT(read_file(path("other.jsonl")), HasSubstr("\"angles_deg\""));
  EXPECT_NE(read_file(path("other.jsonl")), read_file(path("papers.jsonl")));
}

}  // namespace
}  // namespace glovebench::eval
