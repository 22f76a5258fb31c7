// From device frames to the robot's server, for a few seconds; ci/soak does it for minutes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <optional>

#include "ci/build_paths.h"
#include "core/adapters/dds/robot_bus.h"
#include "core/adapters/freenect/live_kinect.h"
#include "core/adapters/kdl/make_arm_solver.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

constexpr int kMissed = 4, kLate = 3;

/// Logs as ci/soak writes them: 200 frames; the first and one other are lost.
class SoakJudge : public testing::Test {
 protected:
  /// `latency_us(i)`: latency of frame i's command; empty: missed.
  template <typename Latency>
  std::string received(const std::vector<std::string>& topics, const Latency& latency_us) {
    std::string log = "{\"event\":\"state\"}\n";
    for (int i = 1; i < kFrames; ++i) {
      if (i == kLost) continue;
      const std::optional<int> latency = latency_us(i);
      for (const std::string& topic : topics) {
        if (!latency) continue;
        log += fmt::format(
            R"({{"event":"received","time_us":{},"topic":"{}","receipt":"{}","stamp_ns":{},"source_us":{}}})",
            kSent + i + *latency, topic,
            i <= refused_ && refuses_.find(topic) != std::string::npos ? receipt_ : "accepted",
            int64_t{i} * step_us_ * 1000, kSent + i);
        log += "\n";
      }
    }
    return log;
  }
  template <typename HandLatency>
  ProgramRun judge(const HandLatency& latency_us, const char* status = "tracked") {
    std::string estimates;
    for (int i = 0; i < kFrames; ++i)
      estimates += fmt::format("{{\"timestamp_us\":{},\"status\":\"{}\"}}\n", i * step_us_,
                               i == 0 || i == kLost ? "no_hand" : status);
    write_file(folder_ + "/estimates.jsonl", estimates);
    write_file(folder_ + "/robot.jsonl",
               received({"fingers", "wrist"}, latency_us) + received({"pose"}, [](int) { return 4000; }));
    return run_program({"/usr/bin/python3", build_paths::source("ci/soak_judge.py"), folder_, seconds_});
  }

  static constexpr int kFrames = 200, kLost = 100;
  static constexpr int64_t kSent = 1'795'363'200'000'000;
  std::string folder_ = test_folder();
  std::string seconds_ = "6";
  int64_t step_us_ = 33'000;
  std::string refuses_ = "fingers wrist pose";  ///< topics
  std::string receipt_ = "starting";            ///< receipt of the first commands
  int refused_ = 7;  ///< number of such commands; a server checks a stream for 0.2 s before it follows
};

TEST_F(SoakJudge, IsContentWithAllInTime) {
  const ProgramRun run = judge([](int i) { return std::optional(i == 7 ? 900'000 : 3000); });
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(
      run.out,
      testing::StartsWith(
          "soak: 6 s, 200 frames at 30.3 Hz, 198 tracked; commands expected 198, received "
          "fingers 198, wrist 198, pose 198, missed 0, stale 0, starting 7; frame to command 3.00 ms median, "
          "4.00 ms p99, 900.00 ms at most "));
}

TEST_F(SoakJudge, TellsMissedFromLate) {
  const ProgramRun late = judge([](int i) { return std::optional(i % 20 == 0 ? 10'000 : 3000); });
  EXPECT_EQ(late.exit_code, kLate) << late.err;
  EXPECT_THAT(late.out, testing::HasSubstr(", missed 0,"));
  const ProgramRun missed = judge([](int i) { return i == 150 ? std::nullopt : std::optional(50'000); });
  EXPECT_EQ(missed.exit_code, kMissed) << "late besides: " << missed.err;
  EXPECT_THAT(missed.out, testing::HasSubstr(", missed 2,"));
  EXPECT_EQ(judge([](int) { return std::optional(3000); }, "no_hand").exit_code, kMissed) << "nothing to judge";
}

TEST_F(SoakJudge, IsNotContentWhereNothingIsFollowed) {
  const auto in_time = [](int) { return std::optional(3000); };
  receipt_ = "stale";
  EXPECT_EQ(judge(in_time).exit_code, kLate) << "7 of 198 on each topic";
  refused_ = kFrames;
  EXPECT_EQ(judge(in_time).exit_code, kLate) << "all came and none was followed";
  receipt_ = "starting";
  EXPECT_EQ(judge(in_time).exit_code, kMissed) << "a start takes 0.2 s, not all the time";
  refused_ = 30;
  EXPECT_EQ(judge(in_time).exit_code, 0) << "starts that add up to a second";
  refused_ = 31;
  EXPECT_EQ(judge(in_time).exit_code, kMissed);
}

TEST_F(SoakJudge, IsNotContentWithoutAStream) {
  const auto in_time = [](int) { return std::optional(3000); };
  seconds_ = "7";
  EXPECT_EQ(judge(in_time).exit_code, kMissed) << "210 frames were played";
  seconds_ = "6";
  step_us_ = 1'000'000;
  EXPECT_EQ(judge(in_time).exit_code, kMissed) << "1 Hz";
  step_us_ = 33'000;
  EXPECT_EQ(judge([](int) { return std::optional(-3000); }).exit_code, kLate) << "received before it was sent";
  receipt_ = "stale", refuses_ = "fingers", refused_ = 5;
  EXPECT_EQ(judge(in_time).exit_code, kLate) << "5 of 198, 0.8% of all topics";
  refused_ = 1;
  EXPECT_EQ(judge(in_time).exit_code, 0);
}

TEST(SoakLong, NoCommandIsMissed) {
  if (!kHasDds || !kHasFreenect || !make_arm_solver()) GTEST_SKIP() << "built without one of the three adapters";
  const ProgramRun run = run_program({build_paths::source("ci/soak"), "4", build_paths::program("glovebench")},
                                     {.environment = {{"GLOVEBENCH_CACHE", test_cache_folder()}}});
  EXPECT_THAT(run.out, testing::StartsWith("soak: 4 s, 120 frames at 30.0 Hz, 120 tracked; commands expected 120, "
                                           "received fingers 120, wrist 120, pose 120, missed 0, stale "))
      << run.err;
  // Latency also depends on the machine's other work.
  EXPECT_THAT(run.exit_code, testing::AnyOf(0, kLate)) << run.err;
}

}  // namespace
}  // namespace glovebench::eval
