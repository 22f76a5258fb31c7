// Trackers that are shell scripts, most of them hostile.
#include "core/adapters/process/process_method.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "ci/build_paths.h"
#include "core/adapters/process/tracker_answer.h"
#include "core/adapters/process/tracker_process.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "core/kinect/disparity.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kWidth = 8, kHeight = 6;

RgbdCalibration small_calibration() {
  RgbdCalibration calibration = synthetic_calibration();
  calibration.ir.width = calibration.rgb.width = kWidth;
  calibration.ir.height = calibration.rgb.height = kHeight;
  return calibration;
}

DeviceFrame small_frame(int number = 0) {
  return {{kWidth, kHeight, 744}, {kWidth, kHeight, Rgb{1, 2, 3}}, 1000 * number, 1000 * number + 1};
}

/// A loop over the frames that runs `body` with the frame's number in $n.
std::string script(const std::string& body) {
  return fmt::format("read start\nn=0\nwhile read header; do head -c {} > images\n{}\nn=$((n+1))\ndone\n",
                     5 * kWidth * kHeight, body);
}
const std::string kAnswer = R"(echo "{\"frame\":$n,\"position_mm\":[1,2,700],\"quaternion_wxyz\":[0,1,0,0]}")";

class ProcessMethodTest : public testing::Test {
 protected:
  ProcessMethodTest() { std::signal(SIGPIPE, SIG_IGN); }

  /// With files of the script in the test's folder.
  std::unique_ptr<Method> make(const std::string& script, ProcessLimits limits = {10s, 10s, 3}) {
    write_file(folder_ + "/tracker.sh", script);
    inputs_.config.method = fmt::format("exec:cd '{}' && exec sh tracker.sh", folder_);
    return make_process_method(inputs_, limits);
  }
  static std::vector<TrackResult> track(Method& method, int frames) {
    std::vector<TrackResult> results;
    for (int f = 0; f < frames; ++f) results.push_back(method.track(small_frame(f), results));
    return results;
  }
  std::vector<std::string> reasons(const std::string& script, int frames, ProcessLimits limits) {
    std::vector<std::string> all;
    const std::unique_ptr<Method> method = make(script, limits);
    for (const TrackResult& result : track(*method, frames)) {
      EXPECT_EQ(result.status, result.reason.empty() ? TrackStatus::tracked : TrackStatus::missing);
      all.push_back(result.reason);
    }
    return all;
  }

  const std::string folder_ = test_folder();
  MethodInputs inputs_{
      {}, small_calibration(), std::make_shared<HandModel>(HandModel::load(build_paths::hand_mesh())), {}, {}};
};

/// True if a process with this command line runs.
bool runs(const std::string& words) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    std::ifstream file(entry.path() / "cmdline");
    std::string line(std::istreambuf_iterator<char>(file), {});
    std::ranges::replace(line, '\0', ' ');
    if (line == words + " ") return true;
  }
  return false;
}

/// Waits up to 10 s. True if such a process then runs, or does not, as expected.
bool becomes(const std::string& words, bool running) {
  const auto deadline = std::chrono::steady_clock::now() + 10s;
  while (runs(words) != running) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(10ms);
  }
  return true;
}

/// A command that no other process has.
std::string unique_sleep() { return fmt::format("sleep {}.{}", 100000 + getpid(), 5); }

TEST_F(ProcessMethodTest, AnswersAreEstimates) {
  const std::unique_ptr<Method> method = make(script(kAnswer));
  const std::vector<TrackResult> results = track(*method, 3);
  for (int f = 0; f < 3; ++f) {
    ASSERT_EQ(results[f].status, TrackStatus::tracked) << results[f].reason;
    EXPECT_EQ(results[f].timestamp_us, 1000 * f);
    EXPECT_TRUE(results[f].T_camera_hand.translation().isApprox(Eigen::Vector3d(0.001, 0.002, 0.7)));
    EXPECT_TRUE(
        results[f].T_camera_hand.linear().isApprox(Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix()));
    EXPECT_TRUE(results[f].has.pose);
    EXPECT_FALSE(results[f].has.posture || results[f].has.internals);
  }
}

TEST_F(ProcessMethodTest, OnlyCalibrationHandAndFramesAreSent) {
  make(
      "read start\nprintf %s \"$start\" > start\nread header\nprintf %s \"$header\" > header\n"
      "head -c 240 > images\nn=0\n" +
      kAnswer)
      ->track(small_frame());
  const auto read_json = [&](const std::string& name) { return nlohmann::json::parse(read_file(folder_ + name)); };
  std::vector<std::string> keys;
  const nlohmann::json start = read_json("/start"), header = read_json("/header");
  for (const auto& [key, value] : start.items()) keys.push_back(key);
  for (const auto& [key, value] : header.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("angles", "calibration", "depth_unit_mm", "hand", "protocol", "version",
                                "color_timestamp_us", "depth_bytes", "depth_timestamp_us", "frame", "rgb_bytes"));
  const std::string images = read_file(folder_ + "/images");
  ASSERT_EQ(images.size(), 5U * kWidth * kHeight);
  const auto units = static_cast<uint16_t>(static_cast<uint8_t>(images[0]) + 256 * static_cast<uint8_t>(images[1]));
  EXPECT_EQ(units, 10002) << "345489 / (1089.41 - 744) = 1000.23 mm";
  EXPECT_EQ(images.substr(2 * kWidth * kHeight, 6), "\1\2\3\1\2\3");
}

TEST_F(ProcessMethodTest, DepthGivesBackTheDisparity) {
  DeviceFrame frame{{2048, 1}, {}, 0, 0};
  for (int raw = 0; raw < 2048; ++raw) frame.raw_disparity(raw, 0) = static_cast<uint16_t>(raw);
  const std::vector<uint16_t> units = depth_units(frame, std::nullopt);
  for (uint16_t raw = 0; raw <= 1036; ++raw)  // up to 6.5 m
    ASSERT_EQ(disparity_from_depth(units[raw] * kDepthUnit_mm / 1000), raw);
  EXPECT_EQ(units[1040], 0) << "beyond 16 bits";
  EXPECT_EQ(units[kNoDisparity], 0);
  frame.depth = depth_of(frame, {});
  frame.raw_disparity = {};
  EXPECT_EQ(depth_units(frame, std::nullopt), units);
  EXPECT_THAT(frame_line(0, frame), HasSubstr("\"depth_bytes\":4096"));
}

TEST_F(ProcessMethodTest, FailuresLoseTheirFrameAndSayWhy) {
  const ProcessLimits patient = {10s, 10s, 1}, quick = {200ms, 200ms, 1};
  const auto fails_with = [&](const std::string& text, const std::string& reason, const ProcessLimits& limits) {
    EXPECT_THAT(reasons(text, 3, limits), ElementsAre(HasSubstr(reason), HasSubstr(reason), HasSubstr("too often")))
        << text;
  };
  fails_with("exit 3", "exit code 3", patient);
  fails_with("kill -SEGV $$", "signal 11", patient);
  fails_with(script("exit 0"), "exit code 0", patient);
  fails_with(script("echo '{\"frame\": 77}'"), "answer to another frame", patient);
  fails_with(script("echo hello"), "answer: ", patient);
  EXPECT_THAT(reasons(script("echo '{\"frame\": 0}'"), 1, patient),
              ElementsAre(HasSubstr("expected angles_deg, position_mm and quaternion_wxyz, or joints_mm")));
  fails_with("exec cat /dev/zero", "a line of more than", patient);
  fails_with("exec yes", "answer: ", patient);
  fails_with("exec >&-; exec sleep 1000", "closed its input or output", patient);
  fails_with(script(":"), "no answer in time", quick);
  fails_with(script("printf '{\"frame\": 0'"), "no answer in time", quick);
  fails_with("exec sleep 1000", "no answer in time", quick);  // the small frame fits into the pipe
}

TEST_F(ProcessMethodTest, TheRunGoesOnAfterAFailure) {
  const ProcessLimits limits = {10s, 10s, 3};
  const std::string text = "if [ ! -e failed ]; then touch failed; exit 5; fi\nread start; n=1\n" +
                           fmt::format("while read header; do head -c {} > images\n{}\nn=$((n+1))\ndone\n",
                                       5 * kWidth * kHeight, kAnswer);
  EXPECT_THAT(reasons(text, 4, limits), ElementsAre(HasSubstr("exit code 5"), "", "", ""));
}

TEST_F(ProcessMethodTest, AnAnswerTooManyIsNotTheNextFrames) {
  EXPECT_THAT(reasons(script(kAnswer + "\n" + kAnswer), 2, {10s, 10s, 0}),
              ElementsAre("", HasSubstr("another frame")));
}

TEST_F(ProcessMethodTest, UnknownCommandsAreRefused) {
  inputs_.config.method = "exec:/no/such/tracker --fast 2>/dev/null";
  EXPECT_THAT(thrown_by([&] { make_process_method(inputs_)->track(small_frame()); }),
              AllOf(HasSubstr("--method"), HasSubstr("/no/such/tracker"), HasSubstr("127")));
  inputs_.config.method = "exec: ";
  EXPECT_THROW(make_process_method(inputs_), Error);
}

TEST_F(ProcessMethodTest, MayWorkAfterTheLastFrame) {
  track(*make(script(kAnswer) + "sleep 0.2; echo done > last"), 2);
  EXPECT_EQ(read_file(folder_ + "/last"), "done\n");
}

TEST_F(ProcessMethodTest, LeavesNoProcessBehind) {
  const std::string words = unique_sleep();
  const std::string hides = fmt::format("trap '' TERM INT HUP PIPE\n(setsid {} &)\n{} &\n", words, words);
  {
    const std::unique_ptr<Method> method = make(hides + script(kAnswer));
    track(*method, 1);
    EXPECT_TRUE(becomes(words, true));
  }
  EXPECT_FALSE(runs(words)) << "after its end";
  reasons(hides + script(":"), 1, {200ms, 200ms, 0});
  EXPECT_FALSE(runs(words)) << "after a failure";
  reasons("for i in $(seq 300); do sh -c '" + words + " &' & done; " + script(":"), 1, {500ms, 500ms, 0});
  EXPECT_FALSE(runs(words)) << "after many";
}

TEST_F(ProcessMethodTest, EndsWithAKilledGlovebench) {
  const std::string words = unique_sleep();
  const pid_t victim = fork();
  if (victim == 0) {
    const std::unique_ptr<Method> method = make(fmt::format("(setsid {} &)\n", words) + script(kAnswer));
    track(*method, 1);
    if (becomes(words, true)) kill(getpid(), SIGKILL);
    _exit(0);
  }
  int status = 0;
  waitpid(victim, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the program ran";
  EXPECT_TRUE(becomes(words, false));
}

TEST_F(ProcessMethodTest, SurvivesRandomReplies) {
  RandomStream random(1, "replies", 0, "test");
  const std::string good = read_file(build_paths::source("ci/corpora/tracker_answer/whole.json"));
  int kept = 0;
  for (int i = 0; i < 10'000; ++i) {
    std::string reply = good;
    for (uint64_t changes = 1 + random.index(6); changes > 0; --changes)
      reply[random.index(reply.size())] = static_cast<char>(random.index(256));
    try {
      kept += parse_answer(reply, 0).has.pose;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(kept, 0);
  constexpr int kFrames = 50;
  const std::vector<std::string> answers =
      reasons("head -c 2000 /dev/urandom; sleep 100", kFrames, {200ms, 200ms, kFrames});
  EXPECT_THAT(answers, Each(testing::Not(testing::IsEmpty())));
}

TEST_F(ProcessMethodTest, HashCoversTheFilesThatTheCommandNames) {
  const std::string file = folder_ + "/my tracker.py", method = "exec:python3 '" + file + "' --fast";
  write_file(file, "one");
  const std::string before = program_hash(method);
  EXPECT_EQ(program_hash(method), before);
  EXPECT_NE(program_hash(method + " "), before);
  write_file(file, "two");
  EXPECT_NE(program_hash(method), before);
}

}  // namespace
}  // namespace glovebench
