#include "core/adapters/dds/server/stated_interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace glovebench {
namespace {

constexpr int64_t kStatedTick = 10'000;

class StatedIntervalTest : public testing::Test {
 protected:
  std::optional<JointInterval> state(bool at_rest) {
    now_us_ += kStatedTick;
    const std::optional<JointInterval> next = stated_.next(at_, at_rest, now_us_);
    if (next) stated_.stated(*next, ++line_, now_us_);
    return next;
  }
  void reaches_disk() { stated_.update(line_, line_, failed_); }
  void is_lost() { stated_.update(line_, durable_, failed_ = line_); }

  std::vector<JointMotion> joints_ = {{-1, 1, 2}, {0, 3, 0.5}};
  StatedInterval stated_{joints_};
  std::vector<double> at_ = {0, 1};
  int64_t now_us_ = 0;
  uint64_t line_ = 0, durable_ = 0, failed_ = 0;
};

TEST_F(StatedIntervalTest, NothingMovesBeforeTheDiskHasIt) {
  EXPECT_FALSE(stated_.allows(at_, 0.01));
  const JointInterval place{{0, 1}, {0, 1}}, ahead{{-1, 0.75}, {1, 1.25}};
  EXPECT_EQ(state(true), place);
  reaches_disk();
  EXPECT_TRUE(stated_.allows(at_, 0));
  EXPECT_FALSE(stated_.allows(at_, 0.01)) << "it said that it rests";
  EXPECT_EQ(state(false), ahead) << "0.5 s at the speeds, within the limits";
  EXPECT_FALSE(stated_.allows(at_, 0.01));
  EXPECT_FALSE(state(false)) << "one at a time";
  reaches_disk();
  EXPECT_TRUE(stated_.allows(at_, 0.5));
  EXPECT_FALSE(stated_.allows(at_, 0.51));
}

TEST_F(StatedIntervalTest, RestatesInTimeAndOnceASecond) {
  state(false);
  reaches_disk();
  EXPECT_FALSE(state(false)) << "nothing is new";
  at_ = {0.5, 1};
  EXPECT_TRUE(stated_.allows(at_, 0.25));
  EXPECT_FALSE(state(false));
  at_ = {0.5, 1.13};
  EXPECT_TRUE(state(false)) << "half of it is over";
  EXPECT_TRUE(stated_.allows(at_, 0.2)) << "meanwhile the older one holds";
  reaches_disk();
  int stated = 0;
  for (int i = 0; i < 300; ++i) {
    stated += state(false).has_value();
    reaches_disk();
  }
  EXPECT_EQ(stated, 3);
}

TEST_F(StatedIntervalTest, ADiskThatFailsIsTriedAgainAndMayHaveEither) {
  state(false);
  reaches_disk();
  ASSERT_TRUE(state(true)) << "it comes to rest";
  EXPECT_FALSE(stated_.allows(at_, 0.01)) << "what is being written may be the last there is";
  durable_ = line_ - 1;
  is_lost();
  EXPECT_FALSE(stated_.allows(at_, 0.01)) << "it may be there nevertheless";
  int tries = 0;
  for (int i = 0; i < 100; ++i) {
    tries += state(false).has_value();
    is_lost();
  }
  EXPECT_GE(tries, 9);
  EXPECT_LE(tries, 11);
  EXPECT_FALSE(stated_.allows(at_, 0.01));
  for (int i = 0; i < 20 && !state(false); ++i) {
  }
  failed_ = line_ - 1;
  reaches_disk();
  EXPECT_TRUE(stated_.allows(at_, 0.5));
}

TEST_F(StatedIntervalTest, ALineThatWasLostBeforeALaterOneIsNotThere) {
  state(false);
  stated_.update(line_ + 1, line_ + 1, line_);  // its line was lost, the next one was written
  EXPECT_FALSE(stated_.allows(at_, 0.01));
}

TEST_F(StatedIntervalTest, OneStepIsEnoughToStart) {
  const double step = 0.01;
  EXPECT_TRUE(is_one_step({{0, 1}, {0, 1}}, joints_, step));
  EXPECT_TRUE(is_one_step({{0, 1}, {0.02, 1.005}}, joints_, step));
  EXPECT_FALSE(is_one_step({{0, 1}, {0.021, 1}}, joints_, step));
  EXPECT_FALSE(is_one_step({{0, 1}, {0, 1.006}}, joints_, step));
}

/// A disk that writes, fails and is late as it likes, and a crash at any moment: whichever of the statements that
/// may be the last one on the disk is read then, the joints are inside it.
TEST_F(StatedIntervalTest, ACrashAtAnyMomentFindsTheJointsInside) {
  std::mt19937 random(3);
  const auto any = [&](int most) { return std::uniform_int_distribution(0, most)(random); };
  std::vector<JointInterval> possible;  // the last ones that a crash may leave
  std::optional<JointInterval> writing;
  int moved = 0;
  bool at_rest = true;
  for (int i = 0; i < 100'000; ++i) {
    if (any(100) == 0) at_rest = !at_rest;
    if (!at_rest && stated_.allows(at_, 0.01)) {
      ++moved;
      for (size_t j = 0; j < at_.size(); ++j)
        at_[j] = std::clamp(at_[j] + joints_[j].speed * 0.01 * (any(2) - 1), joints_[j].min, joints_[j].max);
    }
    for (const JointInterval& interval : possible)
      for (size_t j = 0; j < at_.size(); ++j) {
        ASSERT_GE(at_[j], interval.min[j]) << i;
        ASSERT_LE(at_[j], interval.max[j]) << i;
      }
    if (const auto next = state(at_rest)) possible.push_back(*(writing = next));
    if (!writing || any(3) > 0) continue;
    if (any(2) == 0) {
      is_lost();
    } else {
      durable_ = line_;
      stated_.update(line_, line_, failed_);
      possible.assign(1, *writing);
    }
    writing.reset();
  }
  EXPECT_GT(moved, 10'000);
}

}  // namespace
}  // namespace glovebench
