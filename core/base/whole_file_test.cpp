#include "core/base/whole_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string some_bytes(size_t count) {
  std::string content(count, '\0');
  for (size_t i = 0; i < count; ++i) content[i] = static_cast<char>(i * 131);
  return content;
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

TEST(WholeFile, is_written_through_memory) {
  const TestFolder folder;
  const std::string path = folder / "file", content = some_bytes(10'000);
  WholeFile file(path);
  MappedMemory memory = file.map(content.size());
  EXPECT_EQ(std::ranges::count(memory.bytes(), 0), std::ssize(content));
  std::ranges::copy(content, memory.writable().begin());
  file.commit();
  EXPECT_EQ(read_file(path), content);
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
[[noreturn]] void write_on_a_full_disk(const std::string& path, const std::function<void()>& write) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{100'000, 100'000};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
  try {
    write();
  } catch (const Error& e) {
    _exit(std::string(e.what()).find(path) != std::string::npos ? 0 : 3);
  }
  _exit(4);
}

void expect_error_and_old_content(const std::function<void(const std::string& path)>& write) {
  const TestFolder folder;
  const std::string path = folder / "file";
  write_file(path, "old");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) write_on_a_full_disk(path, [&] { write(path); });
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WholeFile, a_full_disk_is_an_error_and_leaves_the_old_content) {
  expect_error_and_old_content([](const std::string& path) { write_file(path, some_bytes(300'000)); });
}

TEST(WholeFile, a_disk_without_room_to_map_is_an_error_at_once) {
  expect_error_and_old_content([](const std::string& path) { WholeFile(path).map(300'000); });
}

TEST(WholeFile, does_not_stumble_over_what_a_killed_process_of_its_number_left) {
  const TestFolder folder;
  const std::string path = folder / "file";
  for (int i = 0; i < 200; ++i) std::ofstream(fmt::format("{}.tmp-{}-{}", path, getpid(), i)) << "half";
  write_file(path, "whole");
  EXPECT_EQ(read_file(path), "whole");
}

TEST(WholeFile, leftovers_are_removed_by_the_name_of_their_file_unless_they_are_being_written) {
  const TestFolder folder;
  for (const char* name : {"a.csv", "a.csv.tmp-12-0", "b.csv.tmp-1-34", "a.csv.tmp-", "a.csv.tmp-12", "tmp-1-2"})
    write_file(folder / name, name);
  WholeFile writing(folder / "a.csv");
  remove_leftovers(folder.path(), [](const std::string& name) { return name == "a.csv"; });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv.tmp-12-0"));
  EXPECT_EQ(folder.file_count(), 6) << "with the one that is being written";
  writing.append("whole");
  writing.commit();
  EXPECT_EQ(read_file(folder / "a.csv"), "whole");
  remove_leftovers(folder / "none", [](const std::string&) { return true; });  // is none
}

}  // namespace
}  // namespace glovebench
