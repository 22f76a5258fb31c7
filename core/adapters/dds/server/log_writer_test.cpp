#include "core/adapters/dds/server/log_writer.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;

class LogWriterTest : public testing::Test {
 protected:
  template <typename Condition>
  static bool comes_true(const Condition& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }

  std::string path_ = test_folder() + "/log";
};

TEST_F(LogWriterTest, WritesAtOnceAndSaysWhatIsOnTheDisk) {
  LogWriter writer(path_);
  EXPECT_EQ(writer.push("one"), 1U);
  EXPECT_TRUE(comes_true([&] { return read_file(path_) == "one\n"; }));
  EXPECT_EQ(writer.push("two", true), 2U);
  EXPECT_TRUE(comes_true([&] { return writer.progress().durable == 2; }));
  EXPECT_EQ(read_file(path_), "one\ntwo\n");
  writer.push("three");
  writer.finish();
  EXPECT_EQ(read_file(path_), "one\ntwo\nthree\n");
  EXPECT_EQ(writer.progress().durable, 3U);
  EXPECT_EQ(writer.progress().failed, 0U);
  EXPECT_EQ(writer.progress().lost, 0);
  EXPECT_EQ(writer.push("four"), 0U) << "too late";
}

TEST_F(LogWriterTest, AFullDiskIsToldOfAndNothingIsOnIt) {
  LogWriter writer("/dev/full");
  writer.push("one", true);
  EXPECT_TRUE(comes_true([&] { return writer.progress().failed == 1; }));
  EXPECT_EQ(writer.progress().durable, 0U);
  EXPECT_EQ(writer.progress().lost, 1);
  EXPECT_THAT(writer.progress().failure, HasSubstr("space"));
}

TEST_F(LogWriterTest, APipeOrADeviceIsNeverOnTheDisk) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  for (const std::string& path : {path_, std::string("/dev/null")}) {
    LogWriter writer(path);
    writer.push("one", true);
    writer.finish();
    EXPECT_EQ(writer.progress().done, 1U) << path;
    EXPECT_EQ(writer.progress().lost, 0) << path;
    EXPECT_EQ(writer.progress().durable, 0U) << path;
  }
}

TEST_F(LogWriterTest, IsTheOnlyOneOfItsFile) {
  {
    LogWriter first(path_);
    EXPECT_THROW(LogWriter{path_}, Error);
    first.push("one");
  }
  LogWriter(path_).push("two");
  EXPECT_EQ(read_file(path_), "one\ntwo\n");
  const LogWriter device("/dev/null"), again("/dev/null");
}

TEST_F(LogWriterTest, GrowsAndMendsWhatWasCutOff) {
  write_file(path_, "{\"event\":\"st");
  {
    LogWriter writer(path_);
    writer.push("one");
    writer.push("two");
  }
  LogWriter(path_).push("three");
  EXPECT_EQ(read_file(path_), "{\"event\":\"st\none\ntwo\nthree\n");
  EXPECT_EQ(read_tail(path_, 6), "three\n");
  EXPECT_EQ(read_tail(path_, 1000), read_file(path_));
  EXPECT_EQ(read_tail(path_ + "x", 10), "");
}

TEST_F(LogWriterTest, CountsWhatAFullDiskDoesNotTake) {
  LogWriter writer("/dev/full");
  writer.push("one");
  EXPECT_TRUE(comes_true([&] { return writer.progress().lost == 1; }));
  writer.push("two");
  writer.push("three");
  writer.finish();
  EXPECT_EQ(writer.progress().lost, 3);
  EXPECT_EQ(read_tail("/dev/full", 10), "");
  EXPECT_THROW(LogWriter("/nowhere/log"), Error);
}

TEST_F(LogWriterTest, ADiskThatHangsHoldsNobodyUp) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);  // takes 64 KiB, then a write waits for a reader that never comes
  const auto begin = std::chrono::steady_clock::now();
  {
    LogWriter writer(path_);
    const std::string line(999, 'x');
    uint64_t taken = 0;
    for (int i = 0; i < 10'000; ++i) taken += writer.push(line) > 0;  // would hang here, or at the end
    EXPECT_LT(taken, 9000U) << "what waits is bounded";
    EXPECT_GT(taken, 1000U);
    EXPECT_GT(writer.progress().lost, 0);
    writer.finish(std::chrono::seconds(1));
    EXPECT_THAT(writer.progress().failure, HasSubstr("disk that"));
    EXPECT_GE(writer.progress().lost, 9'900) << "all but what the pipe took";
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
  const int reader = open(path_.c_str(), O_RDWR | O_NONBLOCK);  // lets the thread go
  std::string buffer(1 << 20, '\0');
  EXPECT_TRUE(comes_true([&] { return read(reader, buffer.data(), buffer.size()) < 0; }));
  close(reader);
}

}  // namespace
}  // namespace glovebench
