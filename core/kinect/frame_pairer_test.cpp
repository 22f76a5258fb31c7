#include "core/kinect/frame_pairer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "core/base/random.h"

namespace glovebench {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Pairer = FramePairer<int, int>;
using TimePairs = std::vector<std::pair<int64_t, int64_t>>;

/// The times of all pairs that are ready.
TimePairs popped(Pairer& pairer) {
  TimePairs pairs;
  while (const auto pair = pairer.pop()) {
    EXPECT_EQ(pair->depth, pair->depth_us) << "an image belongs to its time stamp";
    EXPECT_EQ(pair->color, pair->color_us);
    pairs.emplace_back(pair->depth_us, pair->color_us);
  }
  return pairs;
}

/// The image is its time, in these tests.
void depth(Pairer& pairer, int64_t time_us) { pairer.push_depth(time_us, static_cast<int>(time_us)); }
void color(Pairer& pairer, int64_t time_us) { pairer.push_color(time_us, static_cast<int>(time_us)); }

TEST(FramePairer, WaitsForTheColorThatMayBeNearer) {
  Pairer pairer;
  color(pairer, 1'000);
  depth(pairer, 11'000);
  EXPECT_THAT(popped(pairer), IsEmpty()) << "one at 12000 would be nearer";
  color(pairer, 22'000);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(11'000, 1'000)));
  depth(pairer, 18'000);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(18'000, 22'000))) << "nothing nearer can come";
}

TEST(FramePairer, TakesTheEarlierOfTwoThatAreEquallyNear) {
  Pairer pairer;
  color(pairer, 1'000);
  depth(pairer, 11'000);
  color(pairer, 21'000);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(11'000, 1'000)));
}

TEST(FramePairer, PairsEqualTimesAtOnce) {
  Pairer pairer;
  depth(pairer, 5);
  EXPECT_THAT(popped(pairer), IsEmpty());
  color(pairer, 5);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(5, 5)));
}

TEST(FramePairer, ColorGoesWithAllDepthThatIsNearIt) {
  Pairer pairer;
  depth(pairer, 10'000);
  depth(pairer, 20'000);
  color(pairer, 30'000);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(10'000, 30'000), std::pair(20'000, 30'000)));
}

TEST(FramePairer, ColorBesideTheLargestGapIsAPartnerAndOneBeyondIsNot) {
  Pairer pairer;
  depth(pairer, 100'000);
  color(pairer, 150'000);
  depth(pairer, 200'001);
  pairer.finish();
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(100'000, 150'000)));
  EXPECT_EQ(pairer.unpaired(), 1);
}

TEST(FramePairer, GivesUpWaitingWhenDepthIsAhead) {
  Pairer pairer;
  color(pairer, 90'000);
  depth(pairer, 100'000);
  depth(pairer, 133'000);
  EXPECT_THAT(popped(pairer), IsEmpty());
  depth(pairer, 166'000);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(100'000, 90'000)));
}

TEST(FramePairer, HoldsNoMoreThanItMay) {
  Pairer pairer({.max_waiting = 3});
  for (int64_t t = 1; t <= 10; ++t) depth(pairer, t);
  EXPECT_EQ(pairer.unpaired(), 7) << "there was no color at all";
  pairer.finish();
  EXPECT_EQ(pairer.unpaired(), 10);

  Pairer colors({.max_waiting = 3});
  for (int64_t t = 1; t <= 10; ++t) color(colors, 1'000 * t);
  depth(colors, 2'000);
  EXPECT_THAT(popped(colors), ElementsAre(std::pair(2'000, 8'000))) << "the older ones are gone";
}

TEST(FramePairer, FinishPairsWhatWaits) {
  Pairer pairer;
  color(pairer, 1'000);
  depth(pairer, 2'000);
  depth(pairer, 60'000);
  pairer.finish();
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(2'000, 1'000)));
  EXPECT_EQ(pairer.unpaired(), 1);
  EXPECT_EQ(pairer.went_back(), 0);
}

TEST(FramePairer, DropsWhatIsNotLaterThanTheOneBefore) {
  Pairer pairer;
  for (int64_t t : {10'000, 10'000, 9'000, 43'000}) depth(pairer, t);
  for (int64_t t : {10'000, 8'000, 43'000}) color(pairer, t);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(10'000, 10'000), std::pair(43'000, 43'000)));
  EXPECT_EQ(pairer.went_back(), 3);
}

TEST(FramePairer, GoesOnWhenTheClockWasStartedAgain) {
  Pairer pairer;
  depth(pairer, 9'000'000);
  color(pairer, 9'000'000);
  depth(pairer, 9'033'000);  // waits, and has no partner when the clock starts again
  depth(pairer, 1'000);
  color(pairer, 2'000);
  EXPECT_THAT(popped(pairer), ElementsAre(std::pair(9'000'000, 9'000'000), std::pair(1'000, 2'000)));
  EXPECT_EQ(pairer.unpaired(), 1);
  EXPECT_EQ(pairer.went_back(), 0);
}

/// What the nearest one is, by looking at all.
TimePairs nearest_of_all(const std::vector<int64_t>& depths, const std::vector<int64_t>& colors) {
  TimePairs pairs;
  for (int64_t d : depths) {
    const auto nearest = std::min_element(colors.begin(), colors.end(), [&](int64_t a, int64_t b) {
      return std::pair(std::abs(a - d), a) < std::pair(std::abs(b - d), b);
    });
    if (nearest != colors.end() && std::abs(*nearest - d) <= 50'000) pairs.emplace_back(d, *nearest);
  }
  return pairs;
}

TEST(FramePairer, PairsAsIfItHadSeenAllOfARecording) {
  int pairs = 0, unpaired = 0;
  for (int seed = 0; seed < 300; ++seed) {
    RandomStream random(seed, "frame_pairer", 0, "times");
    std::vector<int64_t> depths, colors;
    int64_t depth_us = 0, color_us = random.index(200'000);
    for (int i = random.index(40); i > 0; --i) depths.push_back(depth_us += 1 + random.index(90'000));
    for (int i = random.index(40); i > 0; --i) colors.push_back(color_us += 1 + random.index(90'000));

    Pairer pairer;
    size_t d = 0, c = 0;
    while (d < depths.size() || c < colors.size()) {
      const bool depth_next = c == colors.size() || (d < depths.size() && depths[d] < colors[c]);
      if (depth_next) depth(pairer, depths[d++]);
      if (!depth_next) color(pairer, colors[c++]);
    }
    pairer.finish();
    const TimePairs expected = nearest_of_all(depths, colors);
    EXPECT_EQ(popped(pairer), expected) << "seed " << seed;
    EXPECT_EQ(pairer.unpaired(), static_cast<int>(depths.size() - expected.size()));
    pairs += static_cast<int>(expected.size());
    unpaired += pairer.unpaired();
  }
  EXPECT_GT(pairs, 1'000);
  EXPECT_GT(unpaired, 1'000);
}

TEST(FramePairer, SurvivesAnyOrderOfTimes) {
  for (int seed = 0; seed < 200; ++seed) {
    RandomStream random(seed, "frame_pairer", 0, "disorder");
    Pairer pairer({.max_waiting = 4});
    int pushed = 0, came = 0;
    for (int i = 0; i < 200; ++i) {
      const int64_t time_us = random.index(i % 3 == 0 ? 5'000'000 : 200'000);
      const bool is_depth = random.index(2) == 0;
      pushed += is_depth;
      if (is_depth) depth(pairer, time_us);
      if (!is_depth) color(pairer, time_us);
      for (const auto& [depth_us, color_us] : popped(pairer)) {
        EXPECT_LE(std::abs(depth_us - color_us), 50'000);
        ++came;
      }
    }
    pairer.finish();
    came += static_cast<int>(popped(pairer).size());
    EXPECT_LE(came + pairer.unpaired(), pushed) << "each depth image comes out once at most";
    EXPECT_GE(came + pairer.unpaired() + pairer.went_back(), pushed) << "and none is lost without being counted";
  }
}

TEST(TickClock, CountsOnWhereTicksComeAround) {
  TickClock clock;
  EXPECT_EQ(clock.microseconds(4'294'967'280U), 71'582'788);  // 16 ticks before
  EXPECT_EQ(clock.microseconds(44U), 71'582'789);             // 60 ticks later
  int64_t time_us = 0;
  for (int64_t us = 71'600'000; us < 300'000'000; us += 33'333) {
    time_us = clock.microseconds(static_cast<uint32_t>(60 * us));
    ASSERT_EQ(time_us, us);
  }
  EXPECT_GT(time_us, 4 * 71'000'000);
}

TEST(TickClock, LooksBackAcrossTheWrap) {
  TickClock clock;
  EXPECT_EQ(clock.microseconds(600), 10);
  EXPECT_EQ(clock.microseconds(0U - 30U), -1) << "down, as all times";
  EXPECT_EQ(clock.microseconds(0U - 600U), -10);
  EXPECT_EQ(clock.microseconds(600), 10) << "a late stamp of the other stream moves nothing";
}

TEST(TickClock, StartsInTheRoundThatIsKnown) {
  const int64_t first_us = 1'299'626'063'123'456;
  TickClock exact(first_us);
  EXPECT_EQ(exact.microseconds(static_cast<uint32_t>(60 * first_us)), first_us);
  EXPECT_EQ(exact.microseconds(static_cast<uint32_t>(60 * (first_us + 5))), first_us + 5);
  TickClock about(first_us + 30'000'000);
  EXPECT_EQ(about.microseconds(static_cast<uint32_t>(60 * first_us)), first_us);
}

}  // namespace
}  // namespace glovebench
