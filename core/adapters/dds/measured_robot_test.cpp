#include "core/adapters/dds/measured_robot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/server/test_messages.h"
#include "core/adapters/dds/test_peers.h"

namespace glovebench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int64_t kNow = 1'700'000'000'000'000;  // us
constexpr int64_t kAge = 100'000;                // us: what the interface promises
constexpr ros::Time kNoStamp = {};

/// The driver writes what it likes, with any source time; `latest` is asked at any time.
class MeasuredJointsTest : public testing::Test {
 protected:
  void SetUp() override {
    use_loopback_dds(kFarDomain);
    here_ = std::make_unique<DdsParticipant>(kDomain);
    there_ = std::make_unique<DdsParticipant>(kFar);
    joints_ =
        std::make_unique<MeasuredJoints>(*here_, topics::kMeasuredJointStates, std::vector<std::string>{"a", "b"});
    driver_ = std::make_unique<Driver>(*there_, topics::kMeasuredJointStates);
    ASSERT_TRUE(comes_true([&] { return driver_->listeners() == 1; }));
    ASSERT_TRUE(comes_true([&] {  // until the reader knows the driver, too
      driver_->write(good(0), kNow * 1000);
      return latest().has_value();
    }));
  }

  using Driver = DdsWriter<ros::JointState>;
  static ros::JointState good(double a) { return {kNoStamp, {"b", "other", "a"}, {2, 3, a}, {}}; }
  std::optional<std::vector<double>> latest(int64_t after_us = 0) {
    return joints_->latest(kNow + after_us, steady_us_);
  }
  void say(const ros::JointState& message, int64_t source_us = kNow) {
    driver_->write(message, source_us * 1000);
    ASSERT_TRUE(driver_->wait_for_listeners(10));  // it is in the reader's cache
  }
  std::string doubt_about(const ros::JointState& message, int64_t source_us = kNow) {
    say(message, source_us);
    EXPECT_EQ(latest(), std::nullopt);
    const std::string doubt = joints_->doubt();
    say(good(7));
    EXPECT_THAT(latest().value(), ElementsAre(7, 2)) << "the next good one is believed";
    EXPECT_EQ(joints_->doubt(), "");
    return doubt;
  }

  int64_t steady_us_ = 5'000'000;
  std::unique_ptr<DdsParticipant> here_, there_;
  std::unique_ptr<MeasuredJoints> joints_;
  std::unique_ptr<Driver> driver_;
};

TEST_F(MeasuredJointsTest, AnswersInTheOrderOfTheNames) {
  say(good(1));
  EXPECT_THAT(latest().value(), ElementsAre(1, 2));
  say(good(4));
  say(good(5));
  EXPECT_THAT(latest().value(), ElementsAre(5, 2)) << "the newest";
  EXPECT_THAT(latest().value(), ElementsAre(5, 2)) << "also without a new one";
  say({kNoStamp, {"c", "d"}, {8, 9}, {}});
  EXPECT_THAT(latest().value(), ElementsAre(5, 2)) << "other joints are another's";
}

TEST_F(MeasuredJointsTest, BelievesNoStateThatIsIncomplete) {
  EXPECT_EQ(doubt_about({kNoStamp, {"a"}, {1}, {}}), "a state without b");
  EXPECT_EQ(doubt_about({kNoStamp, {"b", "c"}, {1, 2}, {}}), "a state without a");
  EXPECT_EQ(doubt_about({kNoStamp, {"a", "b", "a"}, {1, 2, 1}, {}}), "a twice");
  EXPECT_EQ(doubt_about({kNoStamp, {"a", "b"}, {1, NAN}, {}}), "b at nan");
  EXPECT_EQ(doubt_about({kNoStamp, {"a", "b"}, {-INFINITY, 1}, {}}), "a at -inf");
  EXPECT_EQ(doubt_about({kNoStamp, {"a", "b"}, {1}, {}}), "1 positions of 2 joints");
  EXPECT_EQ(doubt_about({kNoStamp, {"a", "b"}, {1, 2, 3}, {}}), "3 positions of 2 joints");
  EXPECT_EQ(doubt_about({kNoStamp, {"a", "b"}, {}, {}}), "0 positions of 2 joints");
}

TEST_F(MeasuredJointsTest, BelievesNoStateOfAnotherTime) {
  say(good(1), kNow - kAge);
  EXPECT_TRUE(latest());
  EXPECT_FALSE(latest(1000)) << "it has become too old";
  say(good(1), kNow + kAge);
  EXPECT_TRUE(latest());
  EXPECT_EQ(doubt_about(good(1), kNow - 230'000), "a state that is 0.23 s old by its source time");
  EXPECT_EQ(doubt_about(good(1), kNow + 230'000), "a state that is 0.23 s in the future by its source time");
  EXPECT_THAT(doubt_about(good(1), 0), HasSubstr(" old by its source time"));

  ros::JointState stamped = good(1);
  stamped.stamp = test_stamp(kNow - kAge);
  say(stamped);
  EXPECT_TRUE(latest());
  stamped.stamp = test_stamp(kNow - 230'000);
  EXPECT_EQ(doubt_about(stamped), "a state that is 0.23 s old by its stamp");
  stamped.stamp = test_stamp(kNow + 230'000);
  EXPECT_EQ(doubt_about(stamped), "a state that is 0.23 s in the future by its stamp");
}

TEST_F(MeasuredJointsTest, BelievesNoDriverThatFellSilent) {
  say(good(1));
  ASSERT_TRUE(latest());
  steady_us_ += kAge;
  EXPECT_TRUE(latest());
  steady_us_ += 1000;
  EXPECT_FALSE(latest()) << "although the system's clock stands still";
  EXPECT_EQ(joints_->doubt(), "nothing new for 0.10 s");
}

TEST_F(MeasuredJointsTest, BelievesNeitherOfTwo) {
  const DdsParticipant another(kFar);
  const Driver rival(another, topics::kMeasuredJointStates);
  ASSERT_TRUE(comes_true([&] {
    rival.write(good(3), kNow * 1000);
    say(good(1));
    return !latest();
  }));
  EXPECT_EQ(joints_->doubt(), "2 processes that tell of them");
  steady_us_ += 1'100'000;
  say(good(1));
  EXPECT_TRUE(latest()) << "one of them is silent";
}

TEST_F(MeasuredJointsTest, DoesNotHearItself) {
  const Driver own(*here_, topics::kMeasuredJointStates);
  own.write(good(9), kNow * 1000);
  say(good(1));
  EXPECT_THAT(latest().value(), ElementsAre(1, 2));
}

TEST_F(MeasuredJointsTest, SaysThatNobodyTellsOfThem) {
  MeasuredJoints others(*here_, topics::kMeasuredJointStates, {"x"});
  EXPECT_EQ(others.latest(kNow, steady_us_), std::nullopt);
  EXPECT_EQ(others.doubt(), "nothing of them");
}

}  // namespace
}  // namespace glovebench
