#include "core/adapters/dds/server/server_log.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Optional;

const std::vector<std::string> kNames = {"a", "b"};

RobotState state_at(double a_deg, double b_deg) {
  return {17, CommandState::following, {radians_from_degrees(a_deg), radians_from_degrees(b_deg)}, {}};
}

TEST(ServerLog, HasOneObjectALine) {
  EXPECT_EQ(state_line(state_at(-0.0, 89.9999999), 5, kNames),
            R"({"event":"state","time_us":5,"clock_us":17,"state":"following","position_deg":{"a":0,"b":90}})");
  EXPECT_EQ(
      received_line(
          {.time_us = 5, .topic = "pose", .receipt = Receipt::wrong_frame, .stamp_ns = -1, .source_us = 4}),
      R"({"event":"received","time_us":5,"topic":"pose","receipt":"wrong_frame","stamp_ns":-1,"source_us":4})");
}

TEST(ServerLog, SaysWhereTheJointsStood) {
  const std::string first = state_line(state_at(1, 2), 5, kNames) + "\n",
                    last = state_line(state_at(3, 45), 6, kNames);
  const std::string received = received_line({}) + "\n";
  EXPECT_FALSE(last_state("", kNames, "log"));
  EXPECT_FALSE(last_state(received, kNames, "log"));
  const auto expected = Optional(
      AllOf(Field(&LoggedState::time_us, 6),
            Field(&LoggedState::positions, ElementsAre(radians_from_degrees(3), radians_from_degrees(45)))));
  EXPECT_THAT(last_state(first + last + "\n" + received, kNames, "log"), expected);
  EXPECT_THAT(last_state("its beginning is not read\n" + last + "\n", kNames, "log"), expected);
}

TEST(ServerLog, ForgetsALineThatWasCutOff) {
  const std::string first = state_line(state_at(1, 2), 5, kNames) + "\n",
                    last = state_line(state_at(3, 45), 5, kNames);
  const auto expected =
      Optional(Field(&LoggedState::positions, ElementsAre(radians_from_degrees(1), radians_from_degrees(2))));
  for (size_t length = 0; length <= last.size(); ++length) {
    EXPECT_THAT(last_state(first + last.substr(0, length), kNames, "log"), expected) << length;
    if (length < last.size()) {
      EXPECT_THAT(last_state(first + last.substr(0, length) + "\n", kNames, "log"), expected) << length;
    }
  }
}

TEST(ServerLog, OfOtherJointsIsRefused) {
  const std::string log = state_line(state_at(1, 2), 5, kNames) + "\n";
  EXPECT_THROW(last_state(log, {"a", "c"}, "log"), Error);
  EXPECT_THROW(last_state(log, {"a"}, "log"), Error);
  EXPECT_THROW(last_state(state_line(state_at(1, 361), 5, kNames) + "\n", kNames, "log"), Error);
  EXPECT_THROW(last_state("a letter\nto a friend\n", kNames, "log"), Error);
  const auto state = [](const std::string& fields) { return "{\"event\":\"state\"," + fields + "}\n"; };
  EXPECT_TRUE(last_state(state(R"("time_us":1,"position_deg":{"a":1,"b":2})"), kNames, "log"));
  EXPECT_THROW(last_state(state(R"("time_us":1,"position_deg":{"a":"1","b":2})"), kNames, "log"), Error);
  for (const char* time : {"-1", "1.5", "\"1\"", "18446744073709551615", "null"}) {
    EXPECT_THROW(
        last_state(state(fmt::format(R"("time_us":{},"position_deg":{{"a":1,"b":2}})", time)), kNames, "log"),
        Error)
        << time;
  }
  EXPECT_THROW(last_state(state(R"("position_deg":{"a":1,"b":2})"), kNames, "log"), Error);
  EXPECT_THROW(last_state("{\"event\":\"state\",\"time_us\":1}\n", kNames, "log"), Error);
}

TEST(ServerLog, IsBelievedForATime) {
  constexpr int64_t kSecond = 1'000'000, kThen = 1'795'363'200 * kSecond;
  const auto error_after = [&](double seconds, double max_age_s) {
    const int64_t now_us = kThen + std::llround(seconds * 1e6);
    return thrown_by([&] { check_age({kThen, {}}, now_us, max_age_s, "log.jsonl"); });
  };
  EXPECT_EQ(error_after(0, 600), "");
  EXPECT_EQ(error_after(600, 600), "");
  EXPECT_EQ(error_after(-1, 600), "") << "a clock that was corrected";
  EXPECT_EQ(error_after(7200, 7200), "");
  EXPECT_EQ(
      error_after(600.1, 600),
      "log.jsonl: last state: found one of 2026-11-22 16:00:00 UTC, 600.1 s ago, expected one of the last 600 s: "
      "look where the joints stand. If there: a longer --log-age; if at rest: another --log");
  EXPECT_THAT(error_after(3 * 86400, 600), HasSubstr(", 3.0 days ago,"));
  EXPECT_EQ(
      error_after(-1.5, 600),
      "log.jsonl: last state: found one of 2026-11-22 16:00:00 UTC, 1.5 s ahead, expected one of the past: set the "
      "clock, or give the server another --log to start at rest");
  EXPECT_NE(error_after(1, std::nan("")), "");
  EXPECT_NE(error_after(0.1, 0), "");
}

TEST(ServerLog, StatesWhereTheJointsMayBe) {
  const JointInterval interval{{radians_from_degrees(1), radians_from_degrees(-3)},
                               {radians_from_degrees(2.00000014), radians_from_degrees(-3)}};
  const std::string line = interval_line(interval, 5, kNames);
  EXPECT_THAT(line, testing::StartsWith(R"({"event":"interval","time_us":5,"min_deg":{"a":)"));
  const auto read = last_interval(start_line(1, "rest") + "\n" + line + "\n", kNames, "log");
  ASSERT_TRUE(read);
  for (size_t j = 0; j < kNames.size(); ++j) {
    EXPECT_LE(read->min[j], interval.min[j]) << "rounded outwards";
    EXPECT_GE(read->max[j], interval.max[j]);
    EXPECT_NEAR(read->min[j], interval.min[j], radians_from_degrees(1.1e-6));
    EXPECT_NEAR(read->max[j], interval.max[j], radians_from_degrees(1.1e-6));
  }
  EXPECT_FALSE(last_interval(state_line(state_at(1, 2), 5, kNames) + "\n", kNames, "log")) << "an older log";
  for (size_t length = 0; length < line.size(); ++length)
    EXPECT_EQ(last_interval(line + "\n" + line.substr(0, length), kNames, "log"), read) << "cut off";
}

TEST(ServerLog, AnIntervalOfOtherJointsIsRefused) {
  const auto line = [](const char* min, const char* max) {
    return fmt::format(R"({{"event":"interval","time_us":1,"min_deg":{},"max_deg":{}}})", min, max) + "\n";
  };
  EXPECT_TRUE(last_interval(line(R"({"a":1,"b":2})", R"({"a":1,"b":2})"), kNames, "log"));
  for (const char* max : {R"({"a":1})", R"({"a":1,"b":2,"c":3})", R"({"a":1,"c":2})", R"({"a":1,"b":1.9})",
                          R"({"a":1,"b":"2"})", R"({"a":1,"b":361})", "[1,2]", "null"})
    EXPECT_THROW(last_interval(line(R"({"a":1,"b":2})", max), kNames, "log"), Error) << max;
}

TEST(ServerLog, IsWholeIfItsLastStateIsItsLastChange) {
  const LoggedState state{1'000'000'000, {}};
  EXPECT_NO_THROW(check_whole(state, 1'000'000'000, "a.jsonl"));
  EXPECT_NO_THROW(check_whole(state, 1'004'000'000, "a.jsonl")) << "messages come after a state, too";
  EXPECT_NO_THROW(check_whole(state, 990'000'000, "a.jsonl")) << "a copy that kept its date";
  EXPECT_THROW(check_whole(state, 1'006'000'000, "a.jsonl"), Error);
}

}  // namespace
}  // namespace glovebench
