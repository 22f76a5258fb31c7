#include "core/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <regex>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutputExpected = "a file that can be written";

/// The open descriptor that a link in /proc/self/fd stands for.
std::optional<int> descriptor_of(const fs::path& link) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_above(link), error);
  if (error || folder != fs::canonical("/proc/self/fd", error)) return std::nullopt;
  return number_in<int>(link.filename().native());
}

/// Unique within this machine: process id and a counter.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  return fmt::format("{}.tmp-{}-{}", path, getpid(), counter++);
}

}  // namespace

OutputTarget find_output(const std::string& path) {
  if (path == "-") return {.is_stream = true, .descriptor = STDOUT_FILENO, .path = path};
  if (path.empty() || path.back() == '/') throw Error(path, "file", "a folder", kOutputExpected);
  constexpr int kMostLinks = 40;  // as the kernel follows
  fs::path at = path;
  for (int links = 0; links <= kMostLinks; ++links) {
    struct stat found {};
    if (::lstat(at.c_str(), &found) != 0) return {.path = at};
    if (S_ISREG(found.st_mode)) return {.path = at, .older = found};
    if (S_ISDIR(found.st_mode)) throw Error(path, "file", "a folder", kOutputExpected);
    if (!S_ISLNK(found.st_mode)) return {.is_stream = true, .path = at};
    if (const auto descriptor = descriptor_of(at))
      return {.is_stream = true, .descriptor = *descriptor, .path = at};
    struct stat behind {};
    const bool is_there = ::stat(at.c_str(), &behind) == 0;
    if (is_there && !S_ISREG(behind.st_mode) && !S_ISDIR(behind.st_mode)) return {.is_stream = true, .path = at};
    std::error_code error;
    const fs::path next = fs::read_symlink(at, error);
    if (error) throw Error(path, "link", error.message(), kOutputExpected);
    at = at.parent_path() / next;  // `next` alone if it is absolute
  }
  throw Error(path, "link", std::strerror(ELOOP), kOutputExpected);
}

int open_stream(const OutputTarget& target, const std::string& path) {
  const auto open = [&] {
    return target.descriptor >= 0 ? ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0)
                                  : ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  };
  int opened = open();
  while (opened < 0 && errno == EINTR) opened = open();
  if (opened < 0) throw Error(path, "file", std::strerror(errno), kOutputExpected);
  return opened;
}

int create_like(const std::optional<struct stat>& older, const std::string& new_path, mode_t mode) {
  // 0600 first: nobody may read in between what the older file's mode hides.
  const int created = ::open(new_path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, older ? 0600 : mode);
  if (created < 0 || !older) return created;
  struct stat own {};
  const bool differs = ::fstat(created, &own) == 0 && (own.st_uid != older->st_uid || own.st_gid != older->st_gid);
  // Only root may change the owner; otherwise the file belongs to this process's user.
  if (differs && ::fchown(created, older->st_uid, older->st_gid) != 0) errno = 0;
  constexpr mode_t kPermissions = 0777;
  ::fchmod(created, older->st_mode & kPermissions);
  return created;
}

Written write_all(int descriptor, std::string_view content) {
  Written written;
  while (written.bytes < content.size()) {
    const ssize_t count = ::write(descriptor, content.data() + written.bytes, content.size() - written.bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return {written.bytes, count < 0 ? errno : EIO};
    written.bytes += static_cast<size_t>(count);
  }
  return written;
}

int sync_file(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS ? 0 : errno; }

std::string folder_above(const std::string& path) {
  const std::string parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent;
}

void make_folders(const std::string& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error); at = at.parent_path()) missing.push_back(at);
  fs::create_directories(folder.empty() ? "." : folder, error);
  if (error) throw Error(folder, "folder", error.message(), "a folder that can be written");
  for (const fs::path& made : missing) sync_folder(folder_above(made));
}

void sync_folder(const std::string& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;  // a folder that may be written but not read
  const int reason = ::fsync(opened) == 0 ? 0 : errno;
  ::close(opened);
  if (reason == EIO || reason == ENOSPC || reason == EDQUOT)
    throw Error(folder, "folder", std::strerror(reason), "a folder that can be synced");
}

WholeFile::WholeFile(const std::string& path, mode_t mode) : path_(path), target_(find_output(path)) {
  if (target_.is_stream) return;
  make_folders(folder_above(target_.path));
  // A killed process with the same id may have left a file of this name.
  do {
    temporary_ = temporary_name(target_.path);
    descriptor_ = create_like(target_.older, temporary_, mode);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throw Error(path, "file", std::strerror(errno), "a file that can be written");
  ::flock(descriptor_, LOCK_EX | LOCK_NB);  // optional: shows remove_leftovers that the file is in use
}

WholeFile::~WholeFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!target_.is_stream) ::unlink(temporary_.c_str());
}

void WholeFile::append(std::string_view content) {
  if (target_.is_stream && descriptor_ < 0) descriptor_ = open_stream(target_, path_);
  if (const int error = write_all(descriptor_, content).error)
    throw Error(path_, "file", std::strerror(error), "room to write it whole");
}

MappedMemory WholeFile::map(uint64_t bytes) {
  if (target_.is_stream) throw Error(path_, "file", "a device or a pipe", "a file that can be mapped");
  // Reserved now: a page for which there is no room later would end the process.
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  if (error != 0) throw Error(path_, "file", std::strerror(error), fmt::format("room for {} bytes", bytes));
  return MappedMemory::of_descriptor(descriptor_, bytes, path_);
}

void WholeFile::commit() {
  if (descriptor_ < 0) return;  // nothing was written to a stream
  if (const int error = sync_file(descriptor_))
    throw Error(path_, "file", std::strerror(error), "room to write it whole");
  if (!target_.is_stream && ::rename(temporary_.c_str(), target_.path.c_str()) != 0)
    throw Error(path_, "file", std::strerror(errno), "a file that can be replaced");
  ::close(descriptor_);
  descriptor_ = -1;
  if (!target_.is_stream) sync_folder(folder_above(target_.path));
}

void write_file(const std::string& path, std::string_view content) {
  WholeFile file(path);
  file.append(content);
  file.commit();
}

void remove_leftovers(const std::string& folder, const std::function<bool(const std::string& name)>& is_such) {
  static const std::regex temporary(R"((.+)\.tmp-[0-9]+-[0-9]+)");  // as temporary_name makes it
  std::vector<fs::path> leftovers;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    std::smatch match;
    if (std::regex_match(name, match, temporary) && is_such(match[1])) leftovers.push_back(entry.path());
  }
  for (const fs::path& path : leftovers) {
    const int opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (opened < 0) continue;
    if (::flock(opened, LOCK_EX | LOCK_NB) == 0) fs::remove(path, error);
    ::close(opened);
  }
}

}  // namespace glovebench
