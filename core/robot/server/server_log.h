#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/robot/server/receipt.h"
#include "core/robot/server/robot_state.h"

namespace glovebench {

/// What the log of a server tells of a message; core/robot/dds/README.md documents the lines.
struct ReceivedLine {
  int64_t time_us = 0;  ///< of its reception, by the system's clock
  std::string_view topic;
  Receipt receipt = Receipt::accepted;
  int64_t stamp_ns = 0;   ///< of its header
  int64_t source_us = 0;  ///< when its sender had the frame, by the system's clock
};

/// Each as one line of JSON, without the line end. Angles are rounded to 1e-6 degrees. `time_us`: of the system's
/// clock.
std::string received_line(const ReceivedLine& received);
std::string state_line(const RobotState& state, int64_t time_us, const std::vector<std::string>& names);

/// Where the joints stood, and when.
struct LoggedState {
  int64_t time_us = 0;            ///< by the system's clock
  std::vector<double> positions;  ///< rad
};
/// The last state of a log, or of its last part, its joints in the order of `names`. Nothing if there is no state
/// in it, as in an empty log. A line that was cut off, as by a kill, is left out. Throws Error naming `path` if the
/// last state is not one of these joints, or no line is one of a log.
std::optional<LoggedState> last_state(std::string_view log, const std::vector<std::string>& names,
                                      const std::string& path);
/// When a state was, as a person reads it: its time of day, and how long before `now_us` that is.
std::string age_text(const LoggedState& state, int64_t now_us);
/// A server that failed is started again by then, s.
inline constexpr double kMaxLogAge = 600;
/// Throws Error naming `path` and saying what can be done, unless the state is of the `max_age_s` before `now_us`,
/// or as little later as a clock is corrected: whatever was done to the joints since then, nobody has written down.
void check_age(const LoggedState& state, int64_t now_us, double max_age_s, const std::string& path);

/// Throws Error naming `path` if the file was changed (`changed_us`, by the system's clock) seconds after its last
/// state: then later ones could not be written.
void check_whole(const LoggedState& state, int64_t changed_us, const std::string& path);
/// When a file was changed last, microseconds since 1970 by the system's clock. Throws Error.
int64_t changed_us(const std::string& path);

/// The end of a file, at most that many bytes; empty if there is none or it is a device. Throws Error if it cannot
/// be read.
std::string read_tail(const std::string& path, uint64_t max_bytes);

/// A file that grows by a line at a time and has each of them at once, for it is read after a kill. What cannot be
/// written is counted, and the file's time of change goes on: a robot does not stop for a full disk. Nobody else
/// has it as his GrowingFile meanwhile, unless it is a device.
class GrowingFile {
 public:
  /// Opens a file to append to, or none for an empty path. Throws Error if it cannot be opened, or another has it.
  explicit GrowingFile(const std::string& path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(const std::string& line);
  /// Lines that could not be written.
  int64_t lost() const { return lost_; }
  /// Why the first of them was lost.
  const std::string& failure() const { return failure_; }

 private:
  int descriptor_ = -1;
  bool cut_ = false;  ///< the file does not end with a whole line
  int64_t lost_ = 0;
  std::string failure_;
};

}  // namespace glovebench
