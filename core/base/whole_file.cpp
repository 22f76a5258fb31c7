#include "core/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <regex>
#include <vector>

#include "core/base/error.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

/// Unique within this machine: process id and a counter.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  return fmt::format("{}.tmp-{}-{}", path, getpid(), counter++);
}

}  // namespace

int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    content.remove_prefix(static_cast<size_t>(written));
  }
  return 0;
}

WholeFile::WholeFile(const std::string& path) : path_(path), target_(find_output(path)) {
  if (target_.is_stream) return;
  make_folders(folder_above(target_.path));
  // A killed process of the same number may have left one.
  do {
    temporary_ = temporary_name(target_.path);
    descriptor_ = create_like(target_.older, temporary_);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throw Error(path, "file", std::strerror(errno), "a file that can be written");
}

WholeFile::~WholeFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!target_.is_stream) ::unlink(temporary_.c_str());
}

void WholeFile::append(std::string_view content) {
  if (target_.is_stream && descriptor_ < 0) descriptor_ = open_stream(target_, path_);
  if (const int error = write_all(descriptor_, content))
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

void WholeFile::commit(bool sync_folder) {
  if (descriptor_ < 0) return;  // nothing was written to a stream
  // Pipes and most devices hold nothing that could be synced.
  const bool is_synced = ::fsync(descriptor_) == 0 || (target_.is_stream && (errno == EINVAL || errno == EROFS));
  if (!is_synced) throw Error(path_, "file", std::strerror(errno), "room to write it whole");
  if (!target_.is_stream && ::rename(temporary_.c_str(), target_.path.c_str()) != 0)
    throw Error(path_, "file", std::strerror(errno), "a file that can be replaced");
  ::close(descriptor_);
  descriptor_ = -1;
  if (!target_.is_stream && sync_folder) glovebench::sync_folder(folder_above(target_.path));
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
  for (const fs::path& path : leftovers) fs::remove(path, error);
}

}  // namespace glovebench
