// Tracks recordings and checks the files.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "eval/command_test.h"
#include "eval/test_program.h"
#include "reports/estimates.h"

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
  std::map<std::string, std::string> robot = read_folder(path("robot"));
  ASSERT_EQ(robot.erase("manifest.json"), 1U);
  ASSERT_EQ(robot.size(), 1U);
  EXPECT_EQ(read_file(path("tracked_robot.jsonl")), robot.begin()->second)
      << "the robot commands hold the posture and the pose of each frame";
}

TEST_F(TrackLong, WritesCsvPicturesAndAPage) {
  render_recording("good.json", "dump");
  const ProgramRun tracked =
      track("dump", "DB_open_power", "estimates.csv", {"--overlay", path("pictures"), "--page", path("page.html")});
  expect_fine(tracked);
  EXPECT_THAT(tracked.out,
              testing::ContainsRegex("[0-9.]+ frames/s; from frame to estimate [0-9.]+ ms \\(median\\)"));
  const std::vector<reports::Estimate> estimates = reports::read_estimates(path("estimates.csv"));
  ASSERT_EQ(estimates.size(), static_cast<size_t>(kFrames));
  expect_fine(track("dump", "DB_open_power", "estimates.jsonl"));
  const std::string lines = read_file(path("estimates.jsonl"));
  const json first = json::parse(lines.substr(0, lines.find('\n')));
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(first.at("position_mm").at(i), 1000 * estimates[0].T_camera_hand.translation()[i], 1e-3);
  for (int number = 0; number < kFrames; ++number) {
    const std::string file = fmt::format("{}/{:06}.png", path("pictures"), number);
    const ColorImage picture = decode_color(read_file(file), file);
    ASSERT_EQ(picture.width(), 640);
    ASSERT_EQ(picture.height(), 480);
    const auto is_bone = [](const Rgb& rgb) {
      return rgb[0] >= 245 && std::abs(rgb[1] - 210) <= 10 && rgb[2] <= 10;
    };
    EXPECT_GT(std::ranges::count_if(picture, is_bone), 100) << "joints and the bones between them are drawn";
  }
  EXPECT_THAT(read_file(path("page.html")), AllOf(HasSubstr("track-position"), HasSubstr("index_pip_flexion_deg")));
  EXPECT_THAT(track("dump", "DB_open_power", "again.csv", {"--overlay", path("pictures")}).err,
              HasSubstr("pictures: folder: found files in it, expected a new or empty one"));
}

TEST_F(TrackLong, WritesAVideo) {
  render_recording("good.json", "dump");
  expect_fine(track("dump", "DB_open_power", "estimates.csv", {"--overlay", path("hand.mp4")}));
  EXPECT_EQ(read_file(path("hand.mp4")).substr(4, 4), "ftyp");
  EXPECT_FALSE(fs::exists(path("hand.partial.mp4")));
  const std::string frames = path("frames");
  fs::create_directory(frames);
  ASSERT_EQ(std::system(fmt::format("ffmpeg -loglevel error -i {} {}/%d.png", path("hand.mp4"), frames).c_str()),
            0);
  constexpr int kTwice = 2;  // 15 frames/s in a video of 30; the last picture stands once
  EXPECT_EQ(std::distance(fs::directory_iterator(frames), fs::directory_iterator()), kTwice * (kFrames - 1) + 1);
  ProgramSetting without;
  without.environment = {{"PATH", path("nowhere")}};
  EXPECT_THAT(refusal(run_glovebench({"track", "--source", "fakenect:" + path("dump"), "--database",
                                      "DB_open_power", "-o", path("again.csv"), "--overlay", path("again.mp4")},
                                     without)),
              HasSubstr("ffmpeg: program: found No such file or directory"));
  EXPECT_FALSE(fs::exists(path("again.mp4")));
  EXPECT_THAT(track("dump", "DB_open_power", "again.csv", {"--overlay", path("hand.avi")}).err,
              HasSubstr("hand.avi: ending: found .avi, expected .mp4, or none for a folder"));
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
  EXPECT_EQ(track("dump", "DB_open_power", "none.csv").exit_code, 2);
  EXPECT_FALSE(fs::exists(path("none.csv.partial"))) << "no heading without a line";
}

TEST_F(TrackLong, FullDiskKeepsTheOlderCommands) {
  render_recording("good.json", "dump");
  write_file(path("robot.jsonl"), "older");
  expect_fine(track("dump", "DB_open_power", "whole.jsonl", {"--robot-out", path("whole_robot.jsonl")}));
  ProgramSetting full;
  full.max_file_bytes = fs::file_size(path("whole_robot.jsonl")) - 100;
  const std::vector<std::string> command = {"track",
                                            "--source",
                                            "fakenect:" + path("dump"),
                                            "--database",
                                            "DB_open_power",
                                            "-o",
                                            path("estimates.jsonl"),
                                            "--robot-out",
                                            path("robot.jsonl")};
  EXPECT_THAT(refusal(run_glovebench(command, full)),
              AllOf(HasSubstr("robot.jsonl: file: found File too large, expected room"),
                    HasSubstr("kept: 3 lines in " + path("robot.jsonl.partial")),
                    HasSubstr("kept: 4 lines in " + path("estimates.jsonl.partial"))));
  EXPECT_EQ(read_file(path("robot.jsonl")), "older") << "not the first half of the new ones";
  EXPECT_FALSE(fs::exists(path("estimates.jsonl")));
  const std::string commands = read_file(path("robot.jsonl.partial")), whole = read_file(path("whole_robot.jsonl"));
  EXPECT_EQ(commands, whole.substr(0, commands.size()));
  EXPECT_TRUE(commands.ends_with("\n"));

  full.max_file_bytes = fs::file_size(path("whole.jsonl")) - 100;  // the estimates are the shorter lines
  std::vector<std::string> estimates_only = command;
  estimates_only.resize(7);
  EXPECT_THAT(refusal(run_glovebench(estimates_only, full)),
              AllOf(HasSubstr("estimates.jsonl: file: found File too large"),
                    HasSubstr("kept: 3 lines in " + path("estimates.jsonl.partial-2"))));
  const std::string estimates = read_file(path("estimates.jsonl.partial-2"));
  EXPECT_EQ(read_file(path("estimates.jsonl.partial")), read_file(path("whole.jsonl"))) << "of the session before";
  EXPECT_EQ(estimates, read_file(path("whole.jsonl")).substr(0, estimates.size()));
}

TEST_F(TrackLong, WritesThroughDevicesAndPipesAndToStandardOutput) {
  render_recording("good.json", "dump");
  expect_fine(track("dump", "DB_open_power", "whole.jsonl"));
  const std::string whole = read_file(path("whole.jsonl"));
  const auto track_to = [&](const std::string& output) {
    return run_glovebench(
        {"track", "--source", "fakenect:" + path("dump"), "--database", "DB_open_power", "-o", output});
  };
  for (const char* output : {"-", "/dev/stdout"}) {
    const ProgramRun piped = track_to(output);
    EXPECT_EQ(piped.exit_code, 0);
    EXPECT_EQ(piped.out, whole) << "the estimates and nothing else";
    EXPECT_THAT(piped.err, HasSubstr("4 of 4 frames tracked"));
  }
  expect_fine(track_to("/dev/null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(refusal(track_to("/dev/full")), HasSubstr("/dev/full: file: found No space left on device"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));

  write_file(path("target.jsonl"), "older");
  fs::permissions(path("target.jsonl"), fs::perms(0600));
  fs::create_symlink("target.jsonl", path("link.jsonl"));
  expect_fine(track_to(path("link.jsonl")));
  EXPECT_TRUE(fs::is_symlink(path("link.jsonl")));
  EXPECT_EQ(read_file(path("target.jsonl")), whole);
  EXPECT_EQ(fs::status(path("target.jsonl")).permissions(), fs::perms(0600));
}

TEST_F(TrackLong, KilledKeepsItsLines) {
  write_file(path("long.json"), make_trajectory_json("long", 40).dump());
  render_recording("long.json", "dump");
  const StartedProgram started = start_glovebench({"track", "--source", "fakenect:" + path("dump"), "--database",
                                                   "DB_open_power", "-o", path("estimates.jsonl")});
  const std::string partial = path("estimates.jsonl.partial");
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  const auto is_line_there = [&] { return fs::exists(partial) && fs::file_size(partial) > 100; };
  while (!is_line_there() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(started.process, SIGKILL);
  EXPECT_EQ(finish_program(started).exit_code, -1);
  const std::string lines = read_file(partial);
  EXPECT_EQ(json::parse(lines.substr(0, lines.find('\n'))).at("frame"), 0);
  EXPECT_TRUE(lines.ends_with("\n"));
  EXPECT_FALSE(fs::exists(path("estimates.jsonl")));
}

TEST_F(TrackLong, SaysInOneLineWhatWasChangedInARecording) {
  render_recording("good.json", "dump");
  json calibration = json::parse(read_file(path("dump/calibration.json")));
  write_file(path("dump/calibration.json"), calibration.dump());
  const std::string index = read_file(path("dump/INDEX.txt"));
  write_file(path("dump/INDEX.txt"), index.substr(0, index.rfind('\n', index.size() - 2) + 1));
  const ProgramRun run = track("dump", "DB_open_power", "x.jsonl");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err,
            fmt::format("glovebench: fakenect:{}: calibration.json, INDEX.txt changed since it was recorded\n",
                        path("dump")));
  expect_fine(track("dump", "DB_open_power", "x.jsonl", {"--quiet"}));
}

TEST_F(TrackLong, TheFirstSignalEndsAReadOfAPipe) {
  const std::string pipe = path("colors");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    std::signal(signal, SIG_DFL);  // a shell may ignore some in background programs
    const StartedProgram started = start_glovebench({"track", "--source", "fakenect:" + path("dump"), "--database",
                                                     "DB_open_power", "--colors", pipe, "-o", path("x.jsonl")});
    const int writer = ::open(pipe.c_str(), O_WRONLY);  // waits for the program to read
    ::kill(started.process, signal);
    int status = 0;
    for (int i = 0; i < 1000 && ::waitpid(started.process, &status, WNOHANG) == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal;
    ::close(writer);  // ends the open read
  }
}

TEST_F(TrackLong, TakesACalibrationOfItsOwn) {
  render_recording("good.json", "dump");
  json calibration = json::parse(read_file(path("dump/calibration.json")));
  fs::remove(path("dump/calibration.json"));  // as fakenect records
  EXPECT_THAT(refusal(track("dump", "DB_open_power", "x.jsonl")), HasSubstr("calibration.json"));
  // The driver's formula with 2% larger distances.
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
  render_recording("good.json", "dump");
  expect_fine(track("dump", "DB_open_power", "other.jsonl", {"--method", "monocular_bbox"}));
  expect_fine(track("dump", "DB_open_power", "papers.jsonl"));
  EXPECT_THAT(read_file(path("other.jsonl")), HasSubstr("\"angles_deg\""));
  EXPECT_NE(read_file(path("other.jsonl")), read_file(path("papers.jsonl")));
}

}  // namespace
}  // namespace glovebench::eval
