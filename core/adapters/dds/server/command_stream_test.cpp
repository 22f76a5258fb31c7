#include "core/adapters/dds/server/command_stream.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>

namespace glovebench {
namespace {

constexpr int64_t kSecondUs = 1'000'000, kPeriod = 33'333, kTick = 10'000;
constexpr int64_t kEpoch = 1'800'000'000 * kSecondUs;
constexpr int64_t kSilence = 150'000;
constexpr int kTopics = 8;

/// A server that ticks, and a sender whose clock is `offset_` ahead of the server's.
class CommandStreamTest : public testing::Test {
 protected:
  /// Time goes on, with ticks.
  void pass(int64_t us) {
    const int64_t end = now_ + us;
    while (now_ + kTick <= end) {
      now_ += kTick;
      stream_.tick({now_, kEpoch + now_});
    }
    now_ = end;
  }
  /// A message that took `delay` us to come.
  Receipt come(int64_t delay = 300, uint64_t sender = 1, int topic = 0) {
    return receive(stream_, {sender, (now_ - delay + offset_) * 1000, now_}, topic);
  }
  /// Good in itself, without a stamp.
  static Receipt receive(CommandStream& stream, const Arrival& arrival, int topic = 0) {
    return stream.receive(arrival, topic, {}, Receipt::accepted);
  }
  /// Of the last message that was accepted, us: so much sooner it ends to be followed.
  int64_t age() const {
    int64_t age = 0;
    while (age < kSilence && !stream_.is_current(0, now_ + kSilence - age)) ++age;
    return age;
  }
  /// Gaps since the last call.
  int64_t gaps() { return stream_.gaps() - std::exchange(gaps_, stream_.gaps()); }
  /// A stream at 30 Hz; how many of its messages are accepted.
  int live(double seconds, int64_t delay = 300, uint64_t sender = 1) {
    int accepted = 0;
    for (int i = 0; i < seconds * 30; ++i) {
      pass(kPeriod);
      accepted += come(delay, sender) == Receipt::accepted;
    }
    return accepted;
  }

  CommandStream stream_{{}, kTopics};
  int64_t now_ = 100 * kSecondUs, offset_ = -50 * kSecondUs, gaps_ = 0;
};

TEST_F(CommandStreamTest, AStreamIsFollowedAfterAStart) {
  pass(kSecondUs);
  EXPECT_EQ(come(), Receipt::starting);
  for (int i = 0; i < 6; ++i) {
    pass(kPeriod);
    EXPECT_EQ(come(), Receipt::starting) << i;
  }
  pass(kPeriod);
  EXPECT_EQ(come(), Receipt::accepted) << "after 0.2 s: six periods are 2 us less";
  EXPECT_EQ(come(300, 1, 7), Receipt::starting) << "another topic";
  EXPECT_EQ(come(300, 2), Receipt::starting) << "another sender";
}

TEST_F(CommandStreamTest, ALateMessageIsStaleAndTheNextOneIsNot) {
  EXPECT_GT(live(1), 20);
  EXPECT_EQ(come(300), Receipt::accepted);
  EXPECT_EQ(age(), 0);
  EXPECT_EQ(come(100'300), Receipt::accepted);
  EXPECT_EQ(age(), 100'000);
  EXPECT_EQ(come(150'300), Receipt::accepted);
  EXPECT_EQ(come(150'301), Receipt::stale);
  pass(4 * kSecondUs);
  EXPECT_EQ(come(3 * kSecondUs), Receipt::stale);
  EXPECT_EQ(gaps(), 0) << "lateness explains it";
  EXPECT_EQ(come(), Receipt::accepted);
}

TEST_F(CommandStreamTest, OldMessagesOfAnUnknownSenderStartNothing) {
  pass(kSecondUs);
  for (const int64_t between :
       {int64_t{0}, int64_t{10}, int64_t{1000}, int64_t{10'000}, kPeriod, int64_t{90'000}}) {
    CommandStream stream({}, kTopics);
    for (int i = 0; i < 3000; ++i) {  // the first has waited for 6.5 s, and 1 us each is taken
      const Arrival arrival{1, (now_ - 6'500'000 + i * between) * 1000, now_ + i};
      EXPECT_NE(receive(stream, arrival), Receipt::accepted) << between << " us, message " << i;
    }
  }
}

TEST_F(CommandStreamTest, AQueueThatIsEmptiedSlowlyStartsNothing) {
  for (const double faster : {1.2, 1.5, 2.0, 3.0, 10.0}) {
    CommandStream stream({}, kTopics);
    int64_t waited = 5 * kSecondUs;  // of the first one
    for (int i = 0; waited > kSecondUs; ++i) {
      const auto taken = static_cast<int64_t>(static_cast<double>(kPeriod) / faster);
      now_ += taken;
      waited -= kPeriod - taken;
      const Arrival arrival{1, (now_ - waited + offset_) * 1000, now_};
      EXPECT_NE(receive(stream, arrival), Receipt::accepted) << faster << " times, message " << i;
    }
  }
}

TEST_F(CommandStreamTest, OldMessagesAfterAStandstillAreStaleHoweverLongItWas) {
  for (const int64_t standstill : {kSecondUs / 5, 5 * kSecondUs, 9 * kSecondUs, 11 * kSecondUs, 3600 * kSecondUs}) {
    EXPECT_GT(live(1), 10);
    now_ += standstill;
    gaps();
    int accepted = 0;
    for (int64_t waited = standstill; waited > 0; waited -= std::max<int64_t>(kPeriod, standstill / 500)) {
      stream_.ignores(1, now_);
      accepted += come(300 + waited) == Receipt::accepted;
      now_ += 10;
    }
    EXPECT_EQ(gaps(), 1);
    EXPECT_EQ(accepted, 0) << standstill;
    // Some come later still: a writer sends its last ten again.
    pass(200'000);
    for (int i = 10; i > 0 && standstill > kSecondUs; --i)
      EXPECT_EQ(come(300 + 200'000 + i * kPeriod), Receipt::stale) << "sent before the end of the gap";
    EXPECT_EQ(live(0.2), 0) << "and a live stream starts anew";
    EXPECT_GT(live(1), 28);
  }
}

TEST_F(CommandStreamTest, TicksThatAreLateAreAGap) {
  EXPECT_GT(live(1), 20);
  const int64_t last = now_ / kTick * kTick;
  stream_.ignores(1, last + 100'000);
  stream_.tick({last + 100'000, kEpoch + last + 100'000});
  EXPECT_EQ(gaps(), 0);
  stream_.tick({last + 200'001, kEpoch + last + 200'001});
  EXPECT_EQ(gaps(), 1);
  now_ = last + 210'000;
  EXPECT_EQ(come(), Receipt::stale);
}

TEST_F(CommandStreamTest, AClockOfTheServerThatJumpsIsAGap) {
  for (const int64_t jump : {100'001L, -100'001L, 3600 * kSecondUs, -3600 * kSecondUs}) {
    CommandStream stream({}, kTopics);
    stream.tick({kTick, kEpoch});
    EXPECT_EQ(stream.gaps(), 0);
    stream.tick({2 * kTick, kEpoch + kTick + 99'999});
    EXPECT_EQ(stream.gaps(), 0) << "corrected a little";
    stream.tick({3 * kTick, kEpoch + 2 * kTick + 99'999 + jump});
    EXPECT_EQ(stream.gaps(), 1) << jump;
    stream.tick({4 * kTick, kEpoch + 3 * kTick + 99'999 + jump});
    EXPECT_EQ(stream.gaps(), 1);
  }
}

TEST_F(CommandStreamTest, AClockOfASenderThatJumpsStartsItAnew) {
  for (const int64_t jump : {110'000L, -150'000L, 3600 * kSecondUs, -3600 * kSecondUs}) {
    EXPECT_GT(live(1), 10);
    offset_ += jump;
    pass(kPeriod);
    gaps();
    EXPECT_EQ(come(), Receipt::starting) << jump;
    EXPECT_EQ(gaps(), 1) << jump;
    EXPECT_EQ(live(0.15), 0);
    EXPECT_GT(live(1), 25);
  }
  offset_ += 90'000;
  pass(kPeriod);
  come();
  EXPECT_EQ(gaps(), 0) << "corrected a little";
  offset_ -= 90'000;
  pass(kPeriod);
  come();
  EXPECT_EQ(gaps(), 0);
}

TEST_F(CommandStreamTest, ClocksThatDriftAreFollowed) {
  int accepted = live(1);
  for (int i = 0; i < 600; ++i) {  // 200 parts in a million, for 10 minutes
    offset_ -= 200;
    accepted += live(1);
  }
  EXPECT_GE(accepted, 601 * 30 - 7);
  EXPECT_EQ(come(), Receipt::accepted);
  EXPECT_LE(age(), 2000 + 200);
}

TEST_F(CommandStreamTest, WhoWasSilentForLongStartsAnew) {
  EXPECT_GT(live(1), 20);
  pass(9 * kSecondUs);
  EXPECT_EQ(come(), Receipt::accepted);
  pass(12 * kSecondUs);
  EXPECT_EQ(come(5 * kSecondUs), Receipt::starting);
  EXPECT_EQ(gaps(), 0);
  come();
  EXPECT_EQ(gaps(), 1) << "sooner than it can be: the first one was old";
  EXPECT_EQ(come(), Receipt::starting);
}

TEST_F(CommandStreamTest, WithoutSourceTimesNothingIsFollowed) {
  for (int i = 0; i < 1000; ++i) {
    pass(kPeriod);
    for (const int64_t source : {int64_t{0}, std::numeric_limits<int64_t>::min()}) {
      const uint64_t sender = source == 0 ? 1 : 2;
      EXPECT_NE(receive(stream_, {sender, source, now_}), Receipt::accepted);
    }
  }
}

/// A stream at 30 Hz for 3 s; its stamps go on `faster` times as fast as the clock, and some messages come late.
double pace_of(double faster, int64_t late_us) {
  CommandStream stream({}, kTopics);
  int64_t now = 100 * kSecondUs;
  for (int i = 0; i < 90; ++i) {
    now += kPeriod;
    stream.tick({now, kEpoch + now});
    const int64_t source = now - (i % 4 == 0 ? late_us : 0);
    const auto stamp = static_cast<int64_t>(faster * static_cast<double>(source));
    stream.receive({1, source * 1000, now}, 0, ros_time(stamp), Receipt::accepted);
  }
  return stream.pace();
}

TEST(CommandStreamPace, IsThatOfTheStampsAgainstTheClock) {
  EXPECT_NEAR(pace_of(1, 0), 1, 1e-6);
  EXPECT_NEAR(pace_of(12.5, 0), 12.5, 1e-6);
  EXPECT_EQ(pace_of(0, 0), 0) << "without stamps";
}

TEST(CommandStreamPace, OfLateMessagesIsNearlyOne) {
  EXPECT_NEAR(pace_of(1, 15'000), 1, 0.031) << "15 ms of half a second";
}

/// Whatever comes, what is accepted is no older than the limit and the 0.1 s by which a start may be wrong.
TEST_F(CommandStreamTest, NothingOldIsAcceptedWhateverHappens) {
  std::mt19937 random(5);
  const auto any = [&](int64_t most) { return std::uniform_int_distribution<int64_t>(0, most)(random); };
  int accepted = 0;
  for (int round = 0; round < 300; ++round) {
    const int64_t delay = any(3) == 0 ? any(8 * kSecondUs) : any(50'000);  // of the next messages
    switch (any(4)) {
      case 0:
        now_ += any(20 * kSecondUs);
        break;  // the server stands still
      case 1:
        pass(any(15 * kSecondUs));
        break;  // the sender is silent
      default:
        break;
    }
    int64_t waiting = delay;
    while (waiting > 270'000) {  // they come at once; 20 ms of it is usual here
      stream_.ignores(1, now_);
      EXPECT_NE(come(waiting), Receipt::accepted);
      now_ += any(20);
      waiting -= any(2 * kPeriod);
    }
    for (int i = 0; i < 20; ++i) {  // and a live stream follows
      pass(any(2 * kPeriod));
      accepted += come(any(20'000)) == Receipt::accepted;
    }
  }
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace glovebench
