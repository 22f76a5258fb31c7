#pragma once

#include <string>
#include <string_view>

#include "core/base/whole_file.h"

namespace glovebench {

/// Writes lines to NAME.partial (or NAME.partial-2, ...), which `finish` renames to NAME (core/base/README.md).
/// The constructor opens streams.
class LineFile {
 public:
  /// Throws: Error.
  explicit LineFile(const std::string& path);
  /// Removes a partial file without lines.
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Adds the line end. After an error nothing is written.
  /// Throws: Error, which names the partial file.
  void append(std::string_view line);
  /// Throws: Error likewise, and if a line is missing.
  void finish();
  /// "3 lines in NAME.partial". Empty without lines.
  std::string kept() const;

 private:
  [[noreturn]] void fail(int error);

  std::string path_;
  OutputTarget target_;
  std::string partial_;
  int descriptor_ = -1;
  long lines_ = 0;
  off_t bytes_ = 0;
  int error_ = 0;
};

}  // namespace glovebench
