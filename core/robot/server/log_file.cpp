#include "core/robot/server/log_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"

namespace glovebench {
namespace {

/// Locks a file, for as long as it is open.
void lock_file(int descriptor, const std::string& path) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK)
    throw Error(path, "log", "another server that is writing it", "a log of its own for each server");
  throw Error(path, "log", std::strerror(errno), "a file that can be locked");
}

/// The entry of a new file in its folder reaches the disk.
void sync_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw Error(path, "folder", std::strerror(errno), "one that can be opened");
  const bool synced = fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: no file system that keeps anything
  const std::string failure = std::strerror(errno);
  close(descriptor);
  if (!synced) throw Error(path, "folder", failure, "one that can be synced");
}

int64_t line_ends(std::string_view text) {
  return std::ranges::count(text, '\n');
}

}  // namespace

int64_t changed_us(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw Error(path, "log", std::strerror(errno), "a file");
  return int64_t{status.st_mtim.tv_sec} * 1'000'000 + status.st_mtim.tv_nsec / 1000;
}

std::string read_tail(const std::string& path, uint64_t max_bytes) {
  if (!std::filesystem::is_regular_file(path)) return "";
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<int64_t>(file.tellg());
  const int64_t length = std::min(size, static_cast<int64_t>(max_bytes));
  std::string text(static_cast<size_t>(std::max<int64_t>(length, 0)), '\0');
  file.seekg(size - length);
  file.read(text.data(), length);
  if (!file) throw Error(path, "file", "nothing that can be read", "a file");
  return text;
}

GrowingFile::GrowingFile(const std::string& path) {
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw Error(path, "file", std::strerror(errno), "one that can be appended to");
  struct stat status {};
  regular_ = fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!regular_) return;
  try {
    lock_file(descriptor_, path);
    sync_folder_of(path);
  } catch (const Error&) {
    close(descriptor_);
    throw;
  }
  char last = '\n';
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  if (size > 0 && pread(descriptor_, &last, 1, size - 1) == 1) cut_ = last != '\n';
}

GrowingFile::~GrowingFile() {
  close(descriptor_);
}

void GrowingFile::note(const std::string& failure) {
  if (failure_.empty()) failure_ = failure;
}

bool GrowingFile::append(const std::string& lines) {
  const std::string whole = (cut_ ? "\n" : "") + lines + "\n";
  std::string_view left = whole;
  while (!left.empty()) {
    const ssize_t written = write(descriptor_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    left.remove_prefix(static_cast<size_t>(written));
  }
  if (left.size() < whole.size()) cut_ = whole[whole.size() - left.size() - 1] != '\n';
  if (left.empty()) return true;
  note(std::strerror(errno));
  futimens(descriptor_, nullptr);  // takes no room, and tells the next reader that there was more
  lost_ += line_ends(left);
  if (left.size() == whole.size() && whole.front() == '\n') --lost_;  // that end is of a line that was lost before
  return false;
}

bool GrowingFile::sync() {
  if (!regular_ || fdatasync(descriptor_) == 0) return true;
  note(std::strerror(errno));
  return false;
}

}  // namespace glovebench
