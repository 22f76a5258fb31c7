#include "core/base/output_target.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <vector>

#include "core/base/error.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutputExpected = "a file that can be written";

/// The open descriptor that a link in /proc/self/fd stands for.
std::optional<int> descriptor_of(const fs::path& link) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_above(link), error);
  if (error || folder != fs::canonical("/proc/self/fd", error)) return std::nullopt;
  const std::string name = link.filename();
  int descriptor = -1;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), descriptor);
  if (failure != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return descriptor;
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

int create_like(const std::optional<struct stat>& older, const std::string& new_path) {
  // Nobody reads meanwhile what the older file kept from them.
  const int created = ::open(new_path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, older ? 0600 : 0644);
  if (created < 0 || !older) return created;
  struct stat own {};
  const bool differs = ::fstat(created, &own) == 0 && (own.st_uid != older->st_uid || own.st_gid != older->st_gid);
  // Only root may give files away; to others the file is their own from now on.
  if (differs && ::fchown(created, older->st_uid, older->st_gid) != 0) errno = 0;
  constexpr mode_t kPermissions = 0777;
  ::fchmod(created, older->st_mode & kPermissions);
  return created;
}

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
  if (opened < 0) return;  // a folder that may be written, not read
  const int reason = ::fsync(opened) == 0 ? 0 : errno;
  ::close(opened);
  if (reason == EIO || reason == ENOSPC || reason == EDQUOT)
    throw Error(folder, "folder", std::strerror(reason), "a folder that can be synced");
}

}  // namespace glovebench
