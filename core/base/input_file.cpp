#include "core/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr const char* kInputExpected = "a readable file";

const char* kind_name(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  if (S_ISFIFO(mode)) return "a pipe";
  return S_ISSOCK(mode) ? "a socket" : "no file";
}

/// Lets reads of a pipe wait, and waits for its first writer: a pipe without a writer reads like an empty file.
void wait_for_writer(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  ::fcntl(descriptor, F_SETFL, flags & ~O_NONBLOCK);
  pollfd ready = {descriptor, POLLIN, 0};
  while (::poll(&ready, 1, -1) < 0 && errno == EINTR) continue;
}

std::string read_all(const std::string& path, InputFile::Kind kind, uint64_t max_bytes) {
  InputFile file(path, kind);
  const auto check_size = [&](uint64_t bytes) {
    if (bytes > max_bytes)
      throw Error(path, "size", fmt::format("more than {} bytes", max_bytes), fmt::format("at most {}", max_bytes));
  };
  const uint64_t size = file.size().value_or(0);
  check_size(size);
  std::string content;
  content.reserve(size);
  std::vector<char> chunk(1 << 16);
  while (const size_t bytes = file.read(chunk)) {
    content.append(chunk.data(), bytes);
    check_size(content.size());  // a pipe has no size, and a file may grow
  }
  return content;
}

}  // namespace

InputFile::InputFile(const std::string& path, Kind kind) : path_(path) {
  // O_NONBLOCK, since opening a device may block before it can be refused.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) throw Error(path, "file", std::strerror(errno), kInputExpected);
  struct stat status = {};
  const int error = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
  const bool is_file = S_ISREG(status.st_mode);
  const bool is_pipe = kind == Kind::regular_or_pipe && S_ISFIFO(status.st_mode);
  if (error != 0 || (!is_file && !is_pipe)) {
    ::close(descriptor_);
    throw Error(path, "file", error != 0 ? std::strerror(error) : kind_name(status.st_mode), kInputExpected);
  }
  if (is_file) size_ = static_cast<uint64_t>(status.st_size);
  modified_ = status.st_mtim;
  if (is_pipe) wait_for_writer(descriptor_);
}

InputFile::~InputFile() { ::close(descriptor_); }

void InputFile::require_unchanged() const {
  struct stat now = {};
  const bool is_same = ::fstat(descriptor_, &now) == 0 && static_cast<uint64_t>(now.st_size) == size_ &&
                       now.st_mtim.tv_sec == modified_.tv_sec && now.st_mtim.tv_nsec == modified_.tv_nsec;
  if (!is_same)
    throw Error(path_, "file", "one that was changed while it was in use", "one that is replaced whole");
}

size_t InputFile::read(std::span<char> room) {
  while (true) {
    const ssize_t bytes = ::read(descriptor_, room.data(), room.size());
    if (bytes >= 0) return static_cast<size_t>(bytes);
    if (errno != EINTR) throw Error(path_, "file", std::strerror(errno), kInputExpected);
  }
}

std::string read_file(const std::string& path, uint64_t max_bytes) {
  return read_all(path, InputFile::Kind::regular_or_pipe, max_bytes);
}

std::string read_regular_file(const std::string& path, uint64_t max_bytes) {
  return read_all(path, InputFile::Kind::regular, max_bytes);
}

}  // namespace glovebench
