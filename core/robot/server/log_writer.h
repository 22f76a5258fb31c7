#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace glovebench {

/// Writes the lines of a log in a thread of its own: who gives them never waits for a disk, however slow it is.
class LogWriter {
 public:
  /// Throws Error if the file cannot be opened, or another has it (GrowingFile).
  explicit LogWriter(const std::string& path);
  /// As `finish`.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// A line without its end. Its number, from 1; 0 if it was lost because too much waits. All lines are written at
  /// once. They are on the disk a second later, or at once if `urgent`.
  uint64_t push(const std::string& line, bool urgent = false);

  struct Progress {
    uint64_t done = 0;     ///< this line and all before it were written, or lost
    uint64_t durable = 0;  ///< all after `failed` up to this one are on the disk
    uint64_t failed = 0;   ///< this line or one before it is not, perhaps
    int64_t lost = 0;      ///< lines
    std::string failure;   ///< the first one
  };
  Progress progress() const;

  /// Takes no more lines. Waits until all are on the disk, but at most 2 s: those that are not by then are lost.
  void finish();

 private:
  struct Shared;
  static void write_all(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;  ///< with the thread, which a disk may hold beyond this
  std::thread thread_;
};

}  // namespace glovebench
