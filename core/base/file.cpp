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

void write_descriptor(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw Error(std::strerror(errno));
    content.remove_prefix(static_cast<size_t>(written));
  }
  if (::fsync(descriptor) != 0) throw Error(std::strerror(errno));
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

void write_file(const std::string& path, std::string_view content) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) throw Error(folder.string(), "folder", error.message(), "a folder that can be written");

  const std::string temporary = temporary_name(path);
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0) throw Error(path, "file", std::strerror(errno), "a file that can be written");
  try {
    write_descriptor(descriptor, content);
  } catch (const Error& e) {
    ::close(descriptor);
    ::unlink(temporary.c_str());
    throw Error(path, "file", e.what(), "room to write it whole");
  }
  ::close(descriptor);
  if (::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string reason = std::strerror(errno);
    ::unlink(temporary.c_str());
    throw Error(path, "file", reason, "a file that can be replaced");
  }
}

}  // namespace glovebench
