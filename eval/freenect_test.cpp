// The live device through libfreenect's interface, with fakenect behind it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ci/build_paths.h"
#include "core/adapters/freenect/live_kinect.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/kinect/recording_files.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kFrames = 24;

/// A recording that plays in real time.
class Freenect : public testing::Test {
 protected:
  void SetUp() override {
    if (!kHasFreenect) GTEST_SKIP() << "built without libfreenect";
    ASSERT_TRUE(fs::exists(build_paths::fakenect() + "/libfreenect.so.0.5"))
        << "libfreenect comes with fakenect (Debian: libfreenect0.5)";
    folder_ = test_folder();
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  void render_dump(int frames, int64_t start_us, int64_t period_us) const {
    json trajectory = make_trajectory_json("live", frames);
    for (int f = 0; f < frames; ++f) trajectory["frames"][f]["timestamp_us"] = start_us + period_us * f;
    write_file(path("live.json"), trajectory.dump());
    const ProgramRun run =
        run_glovebench({"render", "--trajectory", path("live.json"), "--format", "fakenect", "-o", path("dump")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }

  /// Delays the arrival of each color image after it was taken.
  void delay_colors(int64_t delay_us) const {
    std::vector<std::pair<int64_t, std::string>> files;
    std::istringstream names(read_file(path("dump/INDEX.txt")));
    for (std::string name; std::getline(names, name);) {
      const bool is_color = name[0] == 'r';
      const RecordedName parsed = parse_recorded_name(name, "here");
      const int64_t arrival_us = parsed.timestamp_us + (is_color ? delay_us : 0);
      const std::string delayed = fmt::format("{}-{}.{:06}-{}.{}", name[0], arrival_us / 1'000'000,
                                              arrival_us % 1'000'000, parsed.ticks, is_color ? "ppm" : "pgm");
      files.emplace_back(arrival_us, delayed);
      fs::rename(path("dump/" + name), path("dump/" + delayed));
    }
    std::sort(files.begin(), files.end());
    std::string index;
    for (const auto& [arrival_us, name] : files) index += name + "\n";
    write_file(path("dump/INDEX.txt"), index);
  }

  static std::vector<std::string> track(const std::string& source, const std::string& output,
                                        const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"track", "--source", source, "--database", "DB_open_power", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  ProgramSetting fakenect() const {
    return {.environment = {{"LD_LIBRARY_PATH", build_paths::fakenect()}, {"FAKENECT_PATH", path("dump")}}};
  }
  std::vector<std::string> live(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments =
        track("freenect", path("live.jsonl"), {"--calibration", path("dump/calibration.json"), "--every-frame"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// The message that refuses a recording.
  std::string refusal(const std::vector<std::string>& arguments) const {
    const ProgramRun run = run_glovebench(arguments, fakenect());
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(path("live.jsonl")));
    return run.err;
  }
  std::string some_file(const std::string& extension) const {
    for (const auto& entry : fs::directory_iterator(path("dump")))
      if (entry.path().extension() == extension) return entry.path().string();
    return "";
  }

  std::string folder_;
};

TEST_F(Freenect, GivesTheEstimatesOfTheRecording) {
  render_dump(kFrames, 71'300'000, 20'000);  // across the wrap of the device's clock, at 71.58 s
  delay_colors(12'000);                      // by the computer's clock it is nearer to the next depth image
  const ProgramRun recorded = run_glovebench(track("fakenect:" + path("dump"), path("recorded.jsonl")));
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  EXPECT_THAT(recorded.out, HasSubstr("24 of 24 frames tracked\n"));

  const ProgramRun played = run_glovebench(live(), fakenect());
  EXPECT_EQ(played.exit_code, 0) << played.err;
  EXPECT_THAT(played.out, HasSubstr("24 of 24 frames tracked\n"));
  EXPECT_THAT(played.err, HasSubstr("the end of what fakenect plays"));
  EXPECT_EQ(read_file(path("live.jsonl")), read_file(path("recorded.jsonl")));
}

TEST_F(Freenect, StopsAfterTheFramesThatWereAskedFor) {
  render_dump(30, 0, 20'000);  // a busy machine misses some
  const ProgramRun run = run_glovebench(live({"--frames", "4"}), fakenect());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "") << "not the end of the recording";
  EXPECT_THAT(run.out, HasSubstr("4 of 4 frames tracked"));
}

/// Signals from a user, a supervisor and a closed terminal.
class FreenectSignal : public Freenect, public testing::WithParamInterface<int> {};

INSTANTIATE_TEST_SUITE_P(Signals, FreenectSignal, testing::Values(SIGINT, SIGHUP));

TEST_P(FreenectSignal, FinishesItsOutputWhenInterrupted) {
  render_dump(12, 0, 300'000);
  const StartedProgram started = start_glovebench(live(), fakenect());
  const auto has_begun = [&] {  // the file grows under a temporary name
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().find("live.jsonl") != std::string::npos && entry.file_size() > 0)
        return true;
    return false;
  };
  for (int i = 0; i < 1000 && !has_begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(fs::exists(path("live.jsonl"))) << "not finished yet";
  kill(started.process, GetParam());
  const ProgramRun run = finish_program(started);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("frames tracked"));
  const std::string lines = read_file(path("live.jsonl"));
  const auto count = std::count(lines.begin(), lines.end(), '\n');
  EXPECT_GE(count, 1);
  EXPECT_LT(count, 12);
  EXPECT_TRUE(json::accept(lines.substr(0, lines.find('\n'))));
}

TEST_F(Freenect, RefusesADumpThatWouldEndTheProgram) {
  render_dump(3, 0, 20'000);
  const std::string color = some_file(".ppm"), content = read_file(color);
  fs::resize_file(color, 1000);
  EXPECT_THAT(refusal(live()), AllOf(HasSubstr(color), HasSubstr("1000 bytes")));
  write_file(color, "P3" + content.substr(2));
  EXPECT_THAT(refusal(live()), AllOf(HasSubstr(color), HasSubstr("header")));
  fs::remove(color);
  EXPECT_THAT(refusal(live()), HasSubstr(color));
  const std::string depth = fs::path(some_file(".pgm")).filename();
  write_file(path("dump/INDEX.txt"), depth + "\na-7.000000-5.dump\n");
  EXPECT_THAT(refusal(live()), HasSubstr("a-7.000000-5.dump: file: found nothing"));
  write_file(path("dump/a-7.000000-5.dump"), "twelve bytes");
  write_file(path("dump/INDEX.txt"), "a-7.000000-5.dump\n");
  EXPECT_THAT(refusal(live()), HasSubstr("depth images: found none"));
  fs::remove(path("dump/INDEX.txt"));
  EXPECT_THAT(refusal(live()), HasSubstr("INDEX.txt"));
}

TEST(FreenectUnplugged, IsAFailureThatKeepsWhatWasTracked) {
  if (!kHasFreenect) GTEST_SKIP() << "built without libfreenect";
  const std::string folder = test_folder(), output = folder + "/live.jsonl";
  const ProgramRun run = run_glovebench(
      {"track", "--source", "freenect", "--database", "DB_open_power", "-o", output, "--every-frame"},
      {.environment = {{"LD_LIBRARY_PATH", build_paths::unplugged_freenect()}}});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.out, HasSubstr("0 of 4 frames tracked\n"));
  EXPECT_EQ(run.err,
            "glovebench: freenect: device: found none any more, code -4 (libfreenect: the camera is gone), "
            "expected one that stays plugged in\n");
  const std::string lines = read_file(output);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 4);
}

TEST_F(Freenect, RefusesACalibrationOfOtherImages) {
  render_dump(1, 0, 20'000);
  json calibration = json::parse(read_file(path("dump/calibration.json")));
  calibration["rgb"]["width_px"] = 1280;
  calibration["rgb"]["height_px"] = 1024;
  write_file(path("dump/calibration.json"), calibration.dump());
  EXPECT_THAT(
      refusal(live()),
      HasSubstr("dump/calibration.json: rgb: found 1280x1024 pixels, expected 640x480, the images of a Kinect"));
}

TEST_F(Freenect, RefusesADeviceThatIsNotThere) {
  render_dump(1, 0, 20'000);
  std::vector<std::string> arguments = live();
  arguments[2] = "freenect:63";
  EXPECT_THAT(refusal(arguments), HasSubstr("Kinects that are plugged in: found 1, expected at least 64"));
  // The real library with the present hardware, if it can look at all.
  const ProgramRun run = run_glovebench(arguments);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("glovebench: libfreenect: "));
  for (const char* wrong : {"freenect:", "freenect:x", "freenect:-1", "freenect:1x", "freenect1"}) {
    arguments[2] = wrong;
    EXPECT_THAT(refusal(arguments), HasSubstr("freenect[:INDEX]")) << wrong;
  }
}

}  // namespace
}  // namespace glovebench::eval
