#include "core/base/file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/error.h"

namespace glovebench {

namespace fs = std::filesystem;

std::string read_file(const std::string& path, uint64_t max_bytes) {
  constexpr const char* kExpected = "a readable file";
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error(path, "file", "a folder", kExpected);
  // Not a stream: its buffer takes a read error for the end of the file.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), &std::fclose);
  if (!file) throw Error(path, "file", std::strerror(errno), kExpected);
  std::string content;
  std::vector<char> chunk(1 << 16);
  const auto check_size = [&](uint64_t bytes) {
    if (bytes > max_bytes) {
      throw Error(path, "size", fmt::format("more than {} bytes", max_bytes), fmt::format("at most {}", max_bytes));
    }
  };
  const uintmax_t size = fs::file_size(path, ignored);
  if (!ignored) {
    check_size(size);
    content.reserve(size);
  }
  while (const size_t read = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    content.append(chunk.data(), read);
    check_size(content.size());  // what has no size of its own, a pipe, may still hold too much
  }
  if (std::ferror(file.get())) throw Error(path, "file", std::strerror(errno), kExpected);
  return content;
}

}  // namespace glovebench
