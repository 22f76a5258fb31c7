#include "core/base/line_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LineFile, has_its_name_when_it_is_finished) {
  const TestFolder folder;
  const std::string path = folder / "sub/lines";
  LineFile file(path);
  file.append("one");
  file.append("two");
  EXPECT_EQ(read_file(path + ".partial"), "one\ntwo\n") << "each line as it comes";
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(file.kept(), "2 lines in " + path + ".partial");
  file.finish();
  EXPECT_EQ(read_file(path), "one\ntwo\n");
  EXPECT_EQ(file.kept(), "");
  EXPECT_FALSE(fs::exists(path + ".partial"));
}

TEST(LineFile, keeps_lines_and_an_older_file_when_it_is_not_finished) {
  const TestFolder folder;
  const std::string path = folder / "lines";
  write_file(path, "older");
  for (const char* line : {"first session", "second session"}) LineFile(path).append(line);
  EXPECT_EQ(read_file(path), "older");
  EXPECT_EQ(read_file(path + ".partial"), "first session\n");
  EXPECT_EQ(read_file(path + ".partial-2"), "second session\n");
  { const LineFile without_lines(path); }
  EXPECT_EQ(folder.file_count(), 3);
}

/// Appends lines until the process may write no more. Its exit code says whether the Error is the right one.
[[noreturn]] void fill_the_disk(const std::string& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1000, 1000};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
  LineFile file(path);
  const std::string line(299, 'x');  // three fit, and a part of the fourth
  try {
    for (int i = 0; i < 10; ++i) file.append(line);
  } catch (const Error& e) {
    const bool is_named = std::string(e.what()).find("3 lines in " + path + ".partial") != std::string::npos;
    try {
      file.finish();
    } catch (const Error&) {
      _exit(is_named ? 0 : 3);
    }
  }
  _exit(4);
}

TEST(LineFile, on_a_full_disk_keeps_whole_lines_and_says_where) {
  const TestFolder folder;
  const std::string path = folder / "lines";
  write_file(path, "older");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) fill_the_disk(path);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(read_file(path), "older");
  const std::string kept = read_file(path + ".partial");
  EXPECT_EQ(kept.size(), 900U);
  EXPECT_EQ(std::ranges::count(kept, '\n'), 3);
}

TEST(LineFile, that_cannot_be_renamed_keeps_its_lines) {
  const TestFolder folder;
  const std::string path = folder / "lines";
  LineFile file(path);
  file.append("line");
  fs::create_directories(path + "/in the way");
  EXPECT_THAT([&] { file.finish(); }, ThrowsMessage<Error>(HasSubstr("kept: 1 line in " + path + ".partial")));
  EXPECT_EQ(read_file(path + ".partial"), "line\n");
}

TEST(LineFile, of_a_killed_process_keeps_its_lines) {
  const TestFolder folder;
  const std::string path = folder / "lines";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    LineFile file(path);
    for (int i = 0; i < 100; ++i) file.append("line");
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read_file(path + ".partial").size(), 500U);
}

}  // namespace
}  // namespace glovebench
