#include "core/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

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

std::string read_file(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path, "file", "a folder", "a readable file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path, "file", std::strerror(errno), "a readable file");
  std::ostringstream content;
  content << in.rdbuf();
  if (in.bad()) throw Error(path, "file", "a read error", "a readable file");
  return std::move(content).str();
}

WholeFile::WholeFile(const std::string& path) : path_(path), temporary_(temporary_name(path)) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "folder", error.message(), "a folder that can be written");
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
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

void WholeFile::commit() {
  if (::fsync(descriptor_) != 0) throw Error(path_, "file", std::strerror(errno), "room to write it whole");
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throw Error(path_, "file", std::strerror(errno), "a file that can be replaced");
  }
  ::close(descriptor_);
  descriptor_ = -1;
}

void write_file(const std::string& path, std::string_view content) {
  WholeFile file(path);
  file.append(content);
  file.commit();
}

}  // namespace glovebench
