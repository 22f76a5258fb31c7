#include "core/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <regex>
#include <vector>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

/// Unique within this machine: process id and a counter.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  return fmt::format("{}.tmp-{}-{}", path, getpid(), counter++);
}

}  // namespace

std::string read_file(const std::string& path, uint64_t max_bytes) {
  const auto check_size = [&](uint64_t bytes) {
    if (bytes > max_bytes) {
      throw Error(path, "size", fmt::format("more than {} bytes", max_bytes), fmt::format("at most {}", max_bytes));
    }
  };
  InputFile file(path);
  const uint64_t size = file.size().value_or(0);
  check_size(size);
  std::string content;
  content.reserve(size);
  std::vector<char> chunk(1 << 16);
  while (const size_t bytes = file.read(chunk)) {
    content.append(chunk.data(), bytes);
    check_size(content.size());  // a pipe has no size of its own, and a file may grow
  }
  return content;
}

WholeFile::WholeFile(const std::string& path) : path_(path), temporary_(temporary_name(path)) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "folder", error.message(), "a folder that can be written");
  const auto create = [&] {
    return descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  };
  // A killed process of the same number may have left one.
  while (create() < 0 && errno == EEXIST) temporary_ = temporary_name(path);
  if (descriptor_ < 0) throw Error(path, "file", std::strerror(errno), "a file that can be written");
}

WholeFile::~WholeFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void WholeFile::append(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw Error(path_, "file", std::strerror(errno), "room to write it whole");
    content.remove_prefix(static_cast<size_t>(written));
  }
}

MappedMemory WholeFile::map(uint64_t bytes) {
  // Reserved now: a page for which there is no room later would end the process.
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  if (error != 0) throw Error(path_, "file", std::strerror(error), fmt::format("room for {} bytes", bytes));
  return MappedMemory::of_descriptor(descriptor_, bytes, path_);
}

void WholeFile::commit() {
  if (::fsync(descriptor_) != 0) throw Error(path_, "file", std::strerror(errno), "room to write it whole");
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throw Error(path_, "file", std::strerror(errno), "a file that can be replaced");
  }
  ::close(descriptor_);
  descriptor_ = -1;
}

void WholeFiles::add(const std::string& name, std::string_view content) {
  files_.push_back(std::make_unique<WholeFile>(folder_ + "/" + name));
  files_.back()->append(content);
  names_.push_back(name);
}

void WholeFiles::commit() {
  for (const std::unique_ptr<WholeFile>& file : files_) file->commit();
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
