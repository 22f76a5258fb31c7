#include "core/robot/server/server_log.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/file.h"

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

class ServerLog : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(path_); }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string path_ = testing::TempDir() + "robot-server-" + std::to_string(getpid()) + ".jsonl";
};

TEST_F(ServerLog, HasOneObjectALine) {
  EXPECT_EQ(state_line(state_at(-0.0, 89.9999999), 5, kNames),
            R"({"event":"state","time_us":5,"clock_us":17,"state":"following","position_deg":{"a":0,"b":90}})");
  EXPECT_EQ(
      received_line(
          {.time_us = 5, .topic = "pose", .receipt = Receipt::wrong_frame, .stamp_ns = -1, .source_us = 4}),
      R"({"event":"received","time_us":5,"topic":"pose","receipt":"wrong_frame","stamp_ns":-1,"source_us":4})");
}

TEST_F(ServerLog, SaysWhereTheJointsStood) {
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

TEST_F(ServerLog, ForgetsALineThatWasCutOff) {
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

TEST_F(ServerLog, OfOtherJointsIsRefused) {
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

TEST_F(ServerLog, IsBelievedForATime) {
  constexpr int64_t kSecond = 1'000'000, kThen = 1'795'363'200 * kSecond;
  const auto error_after = [&](double seconds, double max_age_s) -> std::string {
    try {
      check_age({kThen, {}}, kThen + std::llround(seconds * 1e6), max_age_s, "log.jsonl");
    } catch (const Error& e) {
      return e.what();
    }
    return "";
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

TEST_F(ServerLog, IsWrittenByOneAtATime) {
  {
    GrowingFile first(path_);
    EXPECT_THROW(GrowingFile{path_}, Error);
    first.append("one");
  }
  GrowingFile(path_).append("two");
  EXPECT_EQ(read_file(path_), "one\ntwo\n");
  const GrowingFile device("/dev/null"), again("/dev/null");
}

TEST_F(ServerLog, GrowsAndMendsWhatWasCutOff) {
  write_file(path_, "{\"event\":\"st");
  {
    GrowingFile file(path_);
    file.append("one");
    EXPECT_EQ(read_file(path_), "{\"event\":\"st\none\n") << "at once";
    file.append("two");
  }
  GrowingFile(path_).append("three");
  EXPECT_EQ(read_file(path_), "{\"event\":\"st\none\ntwo\nthree\n");
  EXPECT_EQ(read_tail(path_, 6), "three\n");
  EXPECT_EQ(read_tail(path_, 1000), read_file(path_));
  EXPECT_EQ(read_tail(path_ + "x", 10), "");
}

TEST_F(ServerLog, CountsWhatAFullDiskDoesNotTake) {
  GrowingFile file("/dev/full");
  file.append("one");
  file.append("two");
  EXPECT_EQ(file.lost(), 2);
  EXPECT_THAT(file.failure(), HasSubstr("space"));
  EXPECT_EQ(read_tail("/dev/full", 10), "");
  EXPECT_THROW(GrowingFile("/nowhere/log"), Error);
  GrowingFile none("");
  none.append("one");
  EXPECT_EQ(none.lost(), 0);
}

TEST_F(ServerLog, IsWholeIfItsLastStateIsItsLastChange) {
  const LoggedState state{1'000'000'000, {}};
  EXPECT_NO_THROW(check_whole(state, 1'000'000'000, "a.jsonl"));
  EXPECT_NO_THROW(check_whole(state, 1'004'000'000, "a.jsonl")) << "messages come after a state, too";
  EXPECT_NO_THROW(check_whole(state, 990'000'000, "a.jsonl")) << "a copy that kept its date";
  EXPECT_THROW(check_whole(state, 1'006'000'000, "a.jsonl"), Error);
}

}  // namespace
}  // namespace glovebench
