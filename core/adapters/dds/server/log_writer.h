#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace glovebench {

/// When a file was changed last, microseconds since 1970 by the system's clock. Throws Error.
int64_t changed_us(const std::string& path);

/// The end of a file, at most that many bytes; empty if there is none or it is a device. Throws Error if it cannot
/// be read.
std::string read_tail(const std::string& path, uint64_t max_bytes);

/// A log that grows by whole lines. A thread of its own writes them: who gives them never waits for a disk, however
/// slow it is. A line that cannot be written is counted, and the file's time of change goes on.
class LogWriter {
 public:
  /// Opens the file to append to; a new one is in its folder even after a loss of power. Throws Error if it cannot
  /// be opened, or if another LogWriter has it and it is no device or pipe.
  explicit LogWriter(const std::string& path);
  /// As `finish`.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// A line without its end. Its number, from 1; 0 if it was lost because too much waits. All lines are written at
  /// once. They are on the disk a second later, or at once if `urgent`.
  uint64_t push(const std::string& line, bool urgent = false);

  struct Progress {
    uint64_t done = 0;       ///< this line and all before it were written, or lost
    uint64_t durable = 0;    ///< all after `failed` up to this one are on the disk; a device or a pipe has none
    uint64_t failed = 0;     ///< this line or one before it is not, perhaps
    int64_t lost = 0;        ///< lines
    std::string failure;     ///< the first one
    bool misplaced = false;  ///< the file was removed, renamed or cut: its name does not lead to all lines
  };
  Progress progress() const;

  /// Takes no more lines. Waits until all are on the disk, but at most 2 s: those that are not by then are lost.
  void finish();

 private:
  struct Shared;
  static void write_lines(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;  ///< with the thread, which a disk may hold beyond this
  std::thread thread_;
};

}  // namespace glovebench
