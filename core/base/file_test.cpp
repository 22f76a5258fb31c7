#include "core/base/file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "core/base/error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string bytes(size_t count) {
  std::string content(count, '\0');
  for (size_t i = 0; i < count; ++i) content[i] = static_cast<char>(i * 131);
  return content;
}

TEST(File, is_read_as_it_was_written_with_its_folders_made) {
  const TestFolder folder;
  const std::string path = folder / "a/b/c.bin", content = bytes(300'000);
  write_file(path, content);
  EXPECT_EQ(read_file(path), content);
  write_file(path, "");
  EXPECT_EQ(read_file(path), "");
}

TEST(File, errors_name_the_path) {
  const TestFolder folder;
  const std::string missing = folder / "missing";
  EXPECT_THAT([&] { read_file(missing); }, ThrowsMessage<Error>(HasSubstr(missing)));
  EXPECT_THAT([&] { read_file(folder.path()); }, ThrowsMessage<Error>(HasSubstr("a folder")));
  const std::string blocked = folder / "blocked";
  write_file(blocked, "a file where a folder would have to be");
  EXPECT_THAT([&] { write_file(blocked + "/sub/c.txt", "x"); }, ThrowsMessage<Error>(HasSubstr(blocked)));
  EXPECT_THAT([&] { write_file(blocked + "/c.txt", "x"); }, ThrowsMessage<Error>(HasSubstr(blocked)));
}

TEST(File, a_read_error_is_no_empty_file) {
  EXPECT_THAT([] { read_file("/proc/self/mem"); }, ThrowsMessage<Error>(HasSubstr("Input/output error")));
}

TEST(File, larger_than_its_limit_is_refused_before_it_is_read) {
  const TestFolder folder;
  const std::string path = folder / "large";
  write_file(path, "12345");
  EXPECT_EQ(read_file(path, 5), "12345");
  EXPECT_THAT([&] { read_file(path, 4); }, ThrowsMessage<Error>(HasSubstr("more than 4 bytes")));
  std::filesystem::resize_file(path, uintmax_t{1} << 40);  // a hole: it takes no room
  EXPECT_THAT([&] { read_file(path, 1'000'000); }, ThrowsMessage<Error>(HasSubstr("more than 1000000 bytes")));
  EXPECT_THAT([] { read_file("/dev/zero", 1'000'000); }, ThrowsMessage<Error>(HasSubstr("more than 1000000")));
}

TEST(WholeFile, leaves_nothing_without_commit) {
  const TestFolder folder;
  const std::string path = folder / "file";
  {
    WholeFile file(path);
    file.append("half");
    EXPECT_EQ(folder.file_count(), 1);  // the temporary one
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(WholeFile, keeps_the_old_content_until_commit) {
  const TestFolder folder;
  const std::string path = folder / "file";
  write_file(path, "old");
  WholeFile file(path);
  file.append("new ");
  file.append("content");
  EXPECT_EQ(read_file(path), "old");
  file.commit();
  EXPECT_EQ(read_file(path), "new content");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WholeFile, two_writers_do_not_mix) {
  const TestFolder folder;
  const std::string path = folder / "file";
  WholeFile a(path), b(path);
  a.append("aaaa");
  b.append("bb");
  a.commit();
  EXPECT_EQ(read_file(path), "aaaa");
  b.commit();
  EXPECT_EQ(read_file(path), "bb");
}

TEST(WholeFile, a_folder_in_the_way_is_an_error_and_stays) {
  const TestFolder folder;
  const std::string path = folder / "file";
  write_file(path + "/inside", "x");
  EXPECT_THAT([&] { write_file(path, "y"); }, ThrowsMessage<Error>(HasSubstr(path)));
  EXPECT_EQ(read_file(path + "/inside"), "x");
  EXPECT_EQ(folder.file_count(), 1);
}

/// Writes more than the process may; tells by its exit code whether that was an Error that names the file.
[[noreturn]] void write_on_a_full_disk(const std::string& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{100'000, 100'000};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
  try {
    write_file(path, bytes(300'000));
  } catch (const Error& e) {
    _exit(std::string(e.what()).find(path) != std::string::npos ? 0 : 3);
  }
  _exit(4);
}

TEST(WholeFile, a_full_disk_is_an_error_and_leaves_the_old_content) {
  const TestFolder folder;
  const std::string path = folder / "file";
  write_file(path, "old");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) write_on_a_full_disk(path);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WholeFile, leftovers_are_removed_by_the_name_of_their_file) {
  const TestFolder folder;
  for (const char* name : {"a.csv", "a.csv.tmp-12-0", "b.csv.tmp-1-34", "a.csv.tmp-", "a.csv.tmp-12", "tmp-1-2"})
    write_file(folder / name, name);
  remove_leftovers(folder.path(), [](const std::string& name) { return name == "a.csv"; });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv.tmp-12-0"));
  EXPECT_EQ(folder.file_count(), 5);
  remove_leftovers(folder / "none", [](const std::string&) { return true; });  // is none
}

}  // namespace
}  // namespace glovebench
