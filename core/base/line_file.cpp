#include "core/base/line_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/base/error.h"

namespace glovebench {

LineFile::LineFile(const std::string& path) : path_(path), target_(find_output(path)) {
  if (target_.is_stream) {
    descriptor_ = open_stream(target_, path);
    return;
  }
  make_folders(folder_above(target_.path));
  for (int number = 1; descriptor_ < 0; ++number) {
    partial_ = target_.path + (number == 1 ? ".partial" : fmt::format(".partial-{}", number));
    descriptor_ = create_like(target_.older, partial_);
    if (descriptor_ < 0 && errno != EEXIST)
      throw Error(path, "file", std::strerror(errno), "a file that can be written");
  }
  sync_folder(folder_above(partial_));
}

LineFile::~LineFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!partial_.empty() && lines_ == 0) ::unlink(partial_.c_str());
}

void LineFile::append(std::string_view line) {
  if (error_ != 0) fail(error_);
  const std::string text = fmt::format("{}\n", line);
  if (const int error = write_all(descriptor_, text).error) {
    // Removes the part of this line that was written.
    if (!partial_.empty() && ::ftruncate(descriptor_, bytes_) != 0) fail(errno);
    fail(error);
  }
  ++lines_;
  bytes_ += static_cast<off_t>(text.size());
}

void LineFile::finish() {
  if (error_ != 0) fail(error_);
  if (const int error = sync_file(descriptor_)) fail(error);
  if (partial_.empty()) return;
  if (std::rename(partial_.c_str(), target_.path.c_str()) != 0) fail(errno);
  partial_.clear();
  sync_folder(folder_above(target_.path));
}

std::string LineFile::kept() const {
  return partial_.empty() || lines_ == 0
             ? ""
             : fmt::format("{} {} in {}", lines_, lines_ == 1 ? "line" : "lines", partial_);
}

void LineFile::fail(int error) {
  error_ = error;
  const std::string where = kept();
  throw Error(path_, "file", std::strerror(error),
              where.empty() ? "room for every line" : fmt::format("room for every line; kept: {}", where));
}

}  // namespace glovebench
