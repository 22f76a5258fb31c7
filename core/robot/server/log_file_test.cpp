#include "core/robot/server/log_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;

class LogFile : public testing::Test {
 protected:
  std::string path_ = test_folder() + "/log.jsonl";
};

TEST_F(LogFile, IsWrittenByOneAtATime) {
  {
    GrowingFile first(path_);
    EXPECT_THROW(GrowingFile{path_}, Error);
    first.append("one");
  }
  GrowingFile(path_).append("two");
  EXPECT_EQ(read_file(path_), "one\ntwo\n");
  const GrowingFile device("/dev/null"), again("/dev/null");
}

TEST_F(LogFile, GrowsAndMendsWhatWasCutOff) {
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

TEST_F(LogFile, CountsWhatAFullDiskDoesNotTake) {
  GrowingFile file("/dev/full");
  file.append("one");
  file.append("two");
  EXPECT_EQ(file.lost(), 2);
  EXPECT_THAT(file.failure(), HasSubstr("space"));
  EXPECT_EQ(read_tail("/dev/full", 10), "");
  EXPECT_THROW(GrowingFile("/nowhere/log"), Error);
  EXPECT_TRUE(file.sync()) << "a device has no disk to wait for";
  EXPECT_FALSE(file.append("three\nfour"));
  EXPECT_EQ(file.lost(), 4);
}

}  // namespace
}  // namespace glovebench
