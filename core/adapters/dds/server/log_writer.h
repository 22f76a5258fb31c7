#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace glovebench {

/// A file's last change, us since 1970.
/// Throws: Error.
int64_t changed_us(const std::string& path);

/// The last `max_bytes` of a file. Empty if it is missing or a device.
/// Throws: Error.
std::string read_tail(const std::string& path, uint64_t max_bytes);

/// Appends lines in its own thread. A lost line still updates the file's time.
class LogWriter {
 public:
  /// Throws: Error if the file cannot be opened, or another LogWriter has this regular file.
  explicit LogWriter(const std::string& path);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Takes a line without line end. Syncs it within 1 s, or at once if `urgent`. Returns its number, from 1; 0 if
  /// too many lines wait.
  uint64_t push(const std::string& line, bool urgent = false);

  struct Progress {
    uint64_t done = 0;     ///< written or lost up to this line
    uint64_t durable = 0;  ///< lines `failed` + 1 to this one are on the disk; 0: device or pipe
    uint64_t failed = 0;   ///< this or an earlier line may be lost
    int64_t lost = 0;
    std::string failure;
    bool misplaced = false;  ///< the file was removed, renamed or cut
  };
  Progress progress() const;

  /// Waits for the disk, which other writers may keep busy for seconds. Drops the rest.
  void finish(std::chrono::seconds longest = std::chrono::seconds(8));

 private:
  struct Shared;
  static void write_lines(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace glovebench
