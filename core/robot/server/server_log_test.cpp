#include "core/robot/server/server_log.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace glovebench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

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
                    last = state_line(state_at(3, 45), 5, kNames);
  const std::string received = received_line({}) + "\n";
  EXPECT_FALSE(last_positions("", kNames, "log"));
  EXPECT_FALSE(last_positions(received, kNames, "log"));
  const auto expected = ElementsAre(radians_from_degrees(3), radians_from_degrees(45));
  EXPECT_THAT(last_positions(first + last + "\n" + received, kNames, "log"), testing::Optional(expected));
  EXPECT_THAT(last_positions("its beginning is not read\n" + last + "\n", kNames, "log"),
              testing::Optional(expected));
}

TEST_F(ServerLog, ForgetsALineThatWasCutOff) {
  const std::string first = state_line(state_at(1, 2), 5, kNames) + "\n",
                    last = state_line(state_at(3, 45), 5, kNames);
  const auto expected = testing::Optional(ElementsAre(radians_from_degrees(1), radians_from_degrees(2)));
  for (size_t length = 0; length <= last.size(); ++length) {
    EXPECT_THAT(last_positions(first + last.substr(0, length), kNames, "log"), expected) << length;
    if (length < last.size()) {
      EXPECT_THAT(last_positions(first + last.substr(0, length) + "\n", kNames, "log"), expected) << length;
    }
  }
}

TEST_F(ServerLog, OfOtherJointsIsRefused) {
  const std::string log = state_line(state_at(1, 2), 5, kNames) + "\n";
  EXPECT_THROW(last_positions(log, {"a", "c"}, "log"), Error);
  EXPECT_THROW(last_positions(log, {"a"}, "log"), Error);
  EXPECT_THROW(last_positions(state_line(state_at(1, 361), 5, kNames) + "\n", kNames, "log"), Error);
  EXPECT_THROW(last_positions("a letter\nto a friend\n", kNames, "log"), Error);
  EXPECT_THROW(last_positions("{\"event\":\"state\",\"position_deg\":{\"a\":\"1\",\"b\":2}}\n", kNames, "log"),
               Error);
  EXPECT_THROW(last_positions("{\"event\":\"state\",\"time_us\":1}\n", kNames, "log"), Error);
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

}  // namespace
}  // namespace glovebench
