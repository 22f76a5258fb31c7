#pragma once

#include <string>
#include <string_view>

#include "core/base/whole_file.h"

namespace glovebench {

/// Lines that a session writes as they come and nobody can make again. They go to NAME.partial (NAME.partial-2 and
/// so on where an older session left one), which `finish` renames to NAME. Whatever ends the session before that, a
/// full disk, an error or a kill, the lines that were written stay in the partial file, and an older NAME stays as
/// it was. A kill of the process or a full disk leaves whole lines. A power failure may take the last seconds.
///
/// Modes, links, devices and pipes: as WholeFile. A device or a pipe is opened by the constructor.
class LineFile {
 public:
  /// Throws Error.
  explicit LineFile(const std::string& path);
  /// Removes the partial file if it has no line.
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Adds the line end. Throws Error that names the partial file; after that nothing more is written.
  void append(std::string_view line);
  /// Throws Error that names the partial file if the lines cannot be made safe or renamed, or one was not written.
  void finish();
  /// "3 lines in NAME.partial" while that is where they are; empty if there are none, or elsewhere.
  std::string kept() const;

 private:
  [[noreturn]] void fail(int error);

  std::string path_;  ///< as it was given
  OutputTarget target_;
  std::string partial_;  ///< empty: written through, or finished
  int descriptor_ = -1;
  long lines_ = 0;
  off_t bytes_ = 0;
  int error_ = 0;  ///< that ended the writing
};

}  // namespace glovebench
