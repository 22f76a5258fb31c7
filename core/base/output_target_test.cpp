// Where an output goes: devices, pipes, links, modes. Through WholeFile and LineFile, which both ask find_output.
#include "core/base/whole_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/line_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

void write_lines(const std::string& path, const std::string& line) {
  LineFile file(path);
  file.append(line);
  file.finish();
}

mode_t mode_of(const std::string& path) {
  struct stat found {};
  EXPECT_EQ(::stat(path.c_str(), &found), 0);
  return found.st_mode & 07777;
}

/// What arrives at a pipe's other end.
std::string read_pipe(int descriptor) {
  std::string content(1000, '\0');
  const ssize_t count = ::read(descriptor, content.data(), content.size());
  content.resize(static_cast<size_t>(std::max<ssize_t>(count, 0)));
  return content;
}

TEST(Output, writes_through_a_named_pipe) {
  const TestFolder folder;
  const std::string path = folder / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  write_file(path, "whole");
  EXPECT_EQ(read_pipe(reader), "whole");
  write_lines(path, "line");
  EXPECT_EQ(read_pipe(reader), "line\n");
  EXPECT_TRUE(fs::is_fifo(path));
  EXPECT_EQ(folder.file_count(), 1);
  ::close(reader);
}

TEST(Output, of_a_probe_leaves_a_named_pipe_closed) {
  const TestFolder folder;
  const std::string path = folder / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const WholeFile probe(path);  // would wait for a reader
  EXPECT_TRUE(fs::is_fifo(path));
}

TEST(Output, writes_through_devices_and_links_to_them) {
  const TestFolder folder;
  fs::create_symlink("/dev/null", folder / "link");
  write_file(folder / "link", "nothing");
  write_lines(folder / "link", "nothing");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT([] { write_file("/dev/full", "x"); }, ThrowsMessage<Error>(HasSubstr("No space left")));
  EXPECT_THAT([] { write_lines("/dev/full", "x"); }, ThrowsMessage<Error>(HasSubstr("No space left")));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_THAT([] { WholeFile("/dev/null").map(10); }, ThrowsMessage<Error>(HasSubstr("a device or a pipe")));
}

TEST(Output, leaves_a_device_node_what_it_is) {
  const TestFolder folder;
  const std::string path = folder / "node";
  const dev_t null = makedev(1, 3);
  if (::mknod(path.c_str(), S_IFCHR | 0666, null) != 0) GTEST_SKIP() << "only root makes device nodes";
  const int opened = ::open(path.c_str(), O_WRONLY);
  if (opened < 0) GTEST_SKIP() << "no device nodes on this file system";
  ::close(opened);
  write_file(path, "nothing");
  write_lines(path, "nothing");
  EXPECT_TRUE(fs::is_character_file(path));
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Output, appends_to_an_open_descriptor) {
  const TestFolder folder;
  const int file = ::open((folder / "file").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(::write(file, "before ", 7), 7);
  const std::string path = "/dev/fd/" + std::to_string(file);
  write_file(path, "content ");
  write_lines(path, "line");
  ::close(file);
  EXPECT_EQ(read_file(folder / "file"), "before content line\n") << "the same file, where its descriptor stood";
  EXPECT_EQ(folder.file_count(), 1);
  EXPECT_THAT([] { write_file("/dev/fd/1000000", "x"); }, ThrowsMessage<Error>(HasSubstr("/dev/fd/1000000")));
}

TEST(Output, of_standard_output_is_its_descriptor) {
  EXPECT_EQ(find_output("-").descriptor, STDOUT_FILENO);
  EXPECT_EQ(find_output("./-").descriptor, -1);
}

TEST(Output, to_a_socket_is_an_error) {
  const TestFolder folder;
  const std::string path = folder / "socket";
  const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_THAT([&] { write_file(path, "x"); }, ThrowsMessage<Error>(HasSubstr(path)));
  EXPECT_TRUE(fs::is_socket(path));
  ::close(listener);
}

TEST(Output, replaces_the_target_of_links) {
  const TestFolder folder;
  fs::create_directories(folder / "there");
  write_file(folder / "there/file", "old");
  fs::create_symlink("there/file", folder / "link");
  fs::create_symlink(folder / "link", folder / "link-to-link");
  write_file(folder / "link-to-link", "new");
  EXPECT_EQ(read_file(folder / "there/file"), "new");
  write_lines(folder / "link-to-link", "line");
  EXPECT_EQ(read_file(folder / "there/file"), "line\n");
  EXPECT_TRUE(fs::is_symlink(folder / "link") && fs::is_symlink(folder / "link-to-link"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "there"), {}), 1) << "no temporary file";
}

TEST(Output, creates_what_a_dangling_link_names) {
  const TestFolder folder;
  fs::create_symlink("new/file", folder / "link");
  write_file(folder / "link", "content");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "new/file"), "content");
}

TEST(Output, through_a_circle_of_links_is_an_error) {
  const TestFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_THAT([&] { write_file(folder / "a", "x"); }, ThrowsMessage<Error>(HasSubstr("symbolic links")));
  EXPECT_THAT([&] { LineFile(folder / "a"); }, ThrowsMessage<Error>(HasSubstr("symbolic links")));
  EXPECT_EQ(folder.file_count(), 2);
}

TEST(Output, to_a_folder_or_a_link_to_one_is_an_error) {
  const TestFolder folder;
  fs::create_directories(folder / "sub");
  fs::create_symlink("sub", folder / "link");
  for (const std::string& path : {folder / "sub", folder / "link", folder / "sub/", std::string()})
    EXPECT_THAT([&] { write_file(path, "x"); }, ThrowsMessage<Error>(HasSubstr("a folder"))) << path;
  EXPECT_EQ(folder.file_count(), 2);
}

TEST(Output, keeps_the_mode_of_what_it_replaces) {
  const TestFolder folder;
  for (const mode_t mode : {0600, 0644, 0444, 0751}) {
    const std::string path = folder / std::to_string(mode);
    write_file(path, "old");
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    write_file(path, "new");
    EXPECT_EQ(mode_of(path), mode);
    write_lines(path, "newer");
    EXPECT_EQ(mode_of(path), mode);
    EXPECT_EQ(read_file(path), "newer\n");
  }
}

TEST(Output, is_as_private_while_it_is_written) {
  const TestFolder folder;
  write_file(folder / "file", "old");
  ASSERT_EQ(::chmod((folder / "file").c_str(), 0600), 0);
  const WholeFile whole(folder / "file");
  const LineFile lines(folder / "file");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    EXPECT_EQ(mode_of(entry.path()), 0600U) << entry.path();
  EXPECT_EQ(folder.file_count(), 3);
}

TEST(Output, keeps_the_owner_when_root_writes) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  const TestFolder folder;
  write_file(folder / "file", "old");
  ASSERT_EQ(::chown((folder / "file").c_str(), 12345, 54321), 0);
  write_file(folder / "file", "new");
  struct stat found {};
  ASSERT_EQ(::stat((folder / "file").c_str(), &found), 0);
  EXPECT_EQ(found.st_uid, 12345U);
  EXPECT_EQ(found.st_gid, 54321U);
}

TEST(Output, another_hard_link_keeps_the_old_content) {
  const TestFolder folder;
  write_file(folder / "file", "old");
  fs::create_hard_link(folder / "file", folder / "other");
  write_file(folder / "file", "new");
  EXPECT_EQ(read_file(folder / "file"), "new");
  EXPECT_EQ(read_file(folder / "other"), "old");
}

}  // namespace
}  // namespace glovebench
