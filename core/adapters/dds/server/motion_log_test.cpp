#include "core/adapters/dds/server/motion_log.h"

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <functional>

#include "core/adapters/system_time.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;

constexpr double kLogPeriod = 0.01, kMaxAge = 600;

/// A log of two joints.
class MotionLogTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(path_); }
  void TearDown() override { std::filesystem::remove(path_); }

  MotionLog open(const std::string& path) const { return MotionLog(path, {"a", "b"}, joints_); }
  LoggedStart start() const { return open(path_).start({0, 0}, system_us(), kMaxAge, kLogPeriod); }
  /// A tick of a server that has a command, or rests. Returns whether it may move.
  bool tick(MotionLog& log, const std::vector<double>& positions, bool at_rest) {
    clock_us_ += 10'000;
    const CommandState state = at_rest ? CommandState::stopped : CommandState::following;
    log.ticked({clock_us_, state, positions, {}}, system_us(), at_rest);
    return log.may_move(positions, kLogPeriod);
  }
  bool comes_to_move(MotionLog& log, const std::vector<double>& positions) {
    for (int i = 0; i < 2000; ++i) {
      if (tick(log, positions, false)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  std::vector<JointMotion> joints_ = {{-1, 1, 2}, {0, 3, 0.5}};
  std::string path_ = test_folder() + "/log.jsonl";
  int64_t clock_us_ = 1;
};

TEST_F(MotionLogTest, MovesOnlyAfterItsIntervalIsOnTheDisk) {
  MotionLog log = open(path_);
  EXPECT_FALSE(log.may_move({0, 1}, kLogPeriod)) << "nothing was stated";
  ASSERT_TRUE(comes_to_move(log, {0, 1}));
  const auto interval = last_interval(read_file(path_), {"a", "b"}, path_);
  ASSERT_TRUE(interval) << "it is there when the first motion is allowed";
  EXPECT_NEAR(interval->max[1], 1.25, 1e-7);
  EXPECT_FALSE(log.may_move({0, 1}, 0.6));
}

TEST_F(MotionLogTest, AFullDiskHoldsTheJoints) {
  MotionLog log = open("/dev/full");
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(tick(log, {0, 1}, false));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  log.finish({clock_us_, CommandState::stopped, {0, 1}, {}}, system_us());
  EXPECT_GT(log.lost(), 2);
  EXPECT_THAT(log.failure(), HasSubstr("space"));
}

TEST_F(MotionLogTest, WithoutAFileEverythingMayMove) {
  MotionLog log = open("");
  EXPECT_TRUE(tick(log, {0, 1}, false));
  log.finish({1, CommandState::stopped, {0, 1}, {}}, 1);
  EXPECT_EQ(log.lost(), 0);
  EXPECT_EQ(log.start({1, 2}, 0, 0, kLogPeriod).joints, (std::vector<double>{1, 2}));
}

TEST_F(MotionLogTest, ACleanEndSaysWhereTheJointsAre) {
  EXPECT_EQ(start().from, "rest") << "no log yet";
  {
    MotionLog log = open(path_);
    log.started(system_us(), "rest");
    ASSERT_TRUE(comes_to_move(log, {0, 1}));
    tick(log, {0.25, 1.125}, false);
    log.finish({clock_us_ + 1, CommandState::holding, {0.25, 1.125}, {}}, system_us());
  }
  const LoggedStart next = start();
  EXPECT_EQ(next.doubt, "");
  EXPECT_EQ(next.from, "log");
  EXPECT_THAT(next.joints, testing::Pointwise(testing::DoubleNear(1e-7), {0.25, 1.125}));
}

TEST_F(MotionLogTest, AKillInMotionNeedsAMeasuredStateAndOneAtRestDoesNot) {
  const std::vector<std::string> names = {"a", "b"};
  std::string in_motion, at_rest;
  {
    MotionLog log = open(path_);
    ASSERT_TRUE(comes_to_move(log, {0, 1}));
    in_motion = read_file(path_);
    for (int i = 0; i < 2000 && last_interval(read_file(path_), names, path_)->max[1] > 1.01; ++i) {
      tick(log, {0, 1}, true);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    at_rest = read_file(path_);
  }
  write_file(path_, in_motion);
  EXPECT_THAT(start().doubt, HasSubstr("only within 114.6 degrees")) << "2 rad";
  write_file(path_, at_rest);
  EXPECT_EQ(start().doubt, "");
  write_file(path_, in_motion + interval_line({{0, 1}, {0.02, 1.005}}, 1, names) + "\n");
  EXPECT_EQ(start().doubt, "") << "one step";
  write_file(path_, in_motion + interval_line({{0.5, 1}, {0.5, 1}}, 1, names) + "\n");
  EXPECT_THAT(start().doubt, HasSubstr("outside of its last interval"));
  write_file(path_, state_line({1, CommandState::stopped, {0, 1}, {}}, system_us(), names) + "\n");
  EXPECT_NE(start().doubt, "") << "a log of an older version";
}

TEST_F(MotionLogTest, ALogWhoseStatesAreOutOfSightNeedsAMeasuredState) {
  {
    MotionLog log = open(path_);
    ASSERT_TRUE(comes_to_move(log, {0, 1}));
    log.finish({clock_us_ + 1, CommandState::holding, {0, 1}, {}}, system_us());
  }
  ASSERT_EQ(start().doubt, "");
  std::string flood;
  while (flood.size() < (1 << 20)) flood += received_line({}) + "\n";
  write_file(path_, read_file(path_) + flood);
  EXPECT_THAT(start().doubt, HasSubstr("does not say"));
  write_file(path_, received_line({}) + "\n");
  EXPECT_EQ(start().from, "rest") << "nothing ever moved";
}

TEST_F(MotionLogTest, HoldsTheJointsWhereItsNameDoesNotLeadToIt) {
  const auto cut = [&] { std::filesystem::resize_file(path_, 10); };
  const auto rename = [&] { std::filesystem::rename(path_, path_ + ".1"); };
  const auto replace = [&] { write_file(path_, ""); };  // another file gets the name
  const auto remove = [&] { std::filesystem::remove(path_); };
  for (const std::function<void()>& harm : std::vector<std::function<void()>>{cut, rename, replace, remove}) {
    std::filesystem::remove(path_);
    MotionLog log = open(path_);
    ASSERT_TRUE(comes_to_move(log, {0, 1}));
    EXPECT_EQ(log.failure(), "");
    harm();
    int64_t moving = 0;
    for (int i = 0; i < 200; ++i) {
      moving = tick(log, {0, 1 + 1e-9 * i}, false) ? moving + 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(moving, 0) << "states since the last that had to hold";
    EXPECT_GT(log.lost(), 0);
    EXPECT_THAT(log.failure(), HasSubstr("a file that was "));
  }
}

TEST_F(MotionLogTest, AFloodFillsNoDisk) {
  {
    MotionLog log = open(path_);
    for (int i = 0; i < 100'000; ++i) {
      ReceivedLine line;
      line.receipt = i % 2 ? Receipt::accepted : Receipt::stale;
      log.received(line);
      if (i % 1000 == 0) tick(log, {0, 1}, true);  // 100 of them are a second
    }
  }
  const std::string text = read_file(path_);
  EXPECT_LE(std::ranges::count(text, '\n'), 2 * 1000 + 10);
  EXPECT_GE(std::ranges::count(text, '\n'), 2 * 500);
}

}  // namespace
}  // namespace glovebench
