#include "core/base/file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/mapped_memory.h"
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
}

TEST(File, what_may_never_end_is_refused) {
  const TestFolder folder;
  std::filesystem::create_symlink("/dev/zero", folder / "endless");
  EXPECT_THAT([&] { read_file(folder / "endless"); }, ThrowsMessage<Error>(HasSubstr("a device")));
  EXPECT_THAT([] { read_file("/dev/null"); }, ThrowsMessage<Error>(HasSubstr("a device")));
  std::filesystem::create_symlink(folder / "itself", folder / "itself");
  EXPECT_THROW(read_file(folder / "itself"), Error);
  EXPECT_THROW(hash_file(folder / "endless"), Error);
  EXPECT_THROW(MappedMemory::of_file(folder / "endless"), Error);
}

TEST(File, of_a_pipe_is_read_to_its_end_and_bounded) {
  const TestFolder folder;
  const std::string pipe = folder / "pipe", content = bytes(300'000);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto write_later = [&] {
    return std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the reader waits for its writer
      std::ofstream(pipe, std::ios::binary) << content;
    });
  };
  std::signal(SIGPIPE, SIG_IGN);
  std::thread writer = write_later();
  EXPECT_EQ(read_file(pipe, content.size()), content);
  writer.join();
  writer = write_later();
  EXPECT_THAT([&] { read_file(pipe, 1000); }, ThrowsMessage<Error>(HasSubstr("more than 1000 bytes")));
  writer.join();
  std::signal(SIGPIPE, SIG_DFL);
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
  const std::string path = folder / "file", content = bytes(10'000);
  WholeFile file(path);
  MappedMemory memory = file.map(content.size());
  EXPECT_EQ(std::ranges::count(memory.bytes(), 0), std::ssize(content));
  std::ranges::copy(content, memory.writable().begin());
  file.commit();
  EXPECT_EQ(read_file(path), content);
}

TEST(MappedMemory, of_a_file_is_its_content_and_outlives_its_name) {
  const TestFolder folder;
  const std::string path = folder / "file", content = bytes(10'000);
  write_file(path, content);
  const MappedMemory memory = MappedMemory::of_file(path);
  write_file(path, "another");
  EXPECT_TRUE(std::ranges::equal(memory.bytes(), std::as_bytes(std::span(content)), {}, {},
                                 [](std::byte b) { return static_cast<uint8_t>(b); }));
}

TEST(MappedMemory, of_what_is_no_file_is_an_error) {
  const TestFolder folder;
  EXPECT_THAT([&] { MappedMemory::of_file(folder / "none"); }, ThrowsMessage<Error>(HasSubstr(folder / "none")));
  EXPECT_THAT([&] { MappedMemory::of_file(folder.path()); }, ThrowsMessage<Error>(HasSubstr("a folder")));
  EXPECT_THAT([] { MappedMemory::of_file("/dev/null"); }, ThrowsMessage<Error>(HasSubstr("/dev/null")));
  write_file(folder / "empty", "");
  EXPECT_TRUE(MappedMemory::of_file(folder / "empty").bytes().empty());
}

TEST(MappedMemory, moves_and_starts_with_zeros) {
  MappedMemory a = MappedMemory::zeros(5000), b;
  a.writable()[4999] = 7;
  b = std::move(a);
  ASSERT_EQ(b.bytes().size(), 5000u);
  EXPECT_EQ(b.bytes()[4998], 0);
  EXPECT_EQ(b.bytes()[4999], 7);
  EXPECT_TRUE(MappedMemory::zeros(0).bytes().empty());
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
  expect_error_and_old_content([](const std::string& path) { write_file(path, bytes(300'000)); });
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
