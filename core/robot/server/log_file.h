#pragma once

#include <cstdint>
#include <string>

namespace glovebench {

/// When a file was changed last, microseconds since 1970 by the system's clock. Throws Error.
int64_t changed_us(const std::string& path);

/// The end of a file, at most that many bytes; empty if there is none or it is a device. Throws Error if it cannot
/// be read.
std::string read_tail(const std::string& path, uint64_t max_bytes);

/// A file that grows by whole lines. What cannot be written is counted, and the file's time of change goes on.
/// Nobody else has it as his GrowingFile meanwhile, unless it is a device.
class GrowingFile {
 public:
  /// Opens a file to append to. A new one is in its folder even after a loss of power. Throws Error if it cannot be
  /// opened, or another has it.
  explicit GrowingFile(const std::string& path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// One line or more, without the last line end. False if not all of it could be written.
  bool append(const std::string& lines);
  /// Waits until all that was written is on the disk (fdatasync). False if that failed. A device has no disk.
  bool sync();
  /// Lines that could not be written.
  int64_t lost() const { return lost_; }
  /// Why the first line was lost, or the first `sync` failed.
  const std::string& failure() const { return failure_; }

 private:
  void note(const std::string& failure);

  int descriptor_ = -1;
  bool regular_ = false;
  bool cut_ = false;  ///< the file does not end with a whole line
  int64_t lost_ = 0;
  std::string failure_;
};

}  // namespace glovebench
