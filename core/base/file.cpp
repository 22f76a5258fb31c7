#include "core/base/file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace glovebench {

namespace {

std::string read_all(InputFile& file, const std::string& path, uint64_t max_bytes) {
  const auto check_size = [&](uint64_t bytes) {
    if (bytes > max_bytes) {
      throw Error(path, "size", fmt::format("more than {} bytes", max_bytes), fmt::format("at most {}", max_bytes));
    }
  };
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

}  // namespace

std::string read_file(const std::string& path, uint64_t max_bytes) {
  InputFile file(path);
  return read_all(file, path, max_bytes);
}

std::string read_regular_file(const std::string& path, uint64_t max_bytes) {
  InputFile file(path, InputFile::Kind::regular);
  return read_all(file, path, max_bytes);
}

}  // namespace glovebench
