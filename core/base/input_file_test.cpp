#include "core/base/input_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/mapped_memory.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::AllOf;
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

TEST(MappedMemory, of_a_file_is_its_content_and_outlives_its_name) {
  const TestFolder folder;
  const std::string path = folder / "file", content = bytes(10'000);
  write_file(path, content);
  const MappedMemory memory = MappedMemory::of_file(path);
  write_file(path, "another");
  EXPECT_TRUE(std::ranges::equal(memory.bytes(), std::as_bytes(std::span(content)), {}, {},
                                 [](std::byte b) { return static_cast<uint8_t>(b); }));
}

TEST(MappedMemory, tells_a_file_that_was_changed_from_one_that_was_replaced) {
  const TestFolder folder;
  const std::string path = folder / "file";
  write_file(path, bytes(10'000));
  const MappedMemory memory = MappedMemory::of_file(path);
  EXPECT_NO_THROW(memory.require_unchanged());
  std::filesystem::rename(path, folder / "old");
  write_file(path, "another");
  EXPECT_NO_THROW(memory.require_unchanged());
  std::filesystem::last_write_time(folder / "old", std::filesystem::file_time_type::clock::now());
  EXPECT_THAT([&] { memory.require_unchanged(); },
              ThrowsMessage<Error>(AllOf(HasSubstr(path), HasSubstr("changed while it was in use"))));
  const MappedMemory other = MappedMemory::of_file(path);
  std::filesystem::resize_file(path, 3);
  EXPECT_THROW(other.require_unchanged(), Error);
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

}  // namespace
}  // namespace glovebench
