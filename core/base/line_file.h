#pragma once

#include <string>
#include <string_view>

#include "core/base/whole_file.h"

namespace glovebench {

/// Writes lines that cannot be made again to NAME.partial (or NAME.partial-2, ...); `finish` renames it to NAME.
/// After an error or a kill the lines stay in the partial file, and an older NAME is unchanged. A power failure may
/// take the last seconds.
///
/// Modes, links and streams are handled as by WholeFile, but the constructor opens streams.
class LineFile {
 public:
  /// Throws: Error.
  explicit LineFile(const std::string& path);
  /// Removes the partial file if it has no lines.
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Adds the line end; after an error writes nothing more.
  /// Throws: Error naming the partial file.
  void append(std::string_view line);
  /// Throws: Error naming the partial file if it cannot be synced or renamed, or lacks a line.
  void finish();
  /// As "3 lines in NAME.partial"; empty if none are there.
  std::string kept() const;

 private:
  [[noreturn]] void fail(int error);

  std::string path_;
  OutputTarget target_;
  std::string partial_;  ///< empty for streams and after `finish`
  int descriptor_ = -1;
  long lines_ = 0;
  off_t bytes_ = 0;
  int error_ = 0;  ///< errno; 0: none
};

}  // namespace glovebench
