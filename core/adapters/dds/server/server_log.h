#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/adapters/dds/server/command_messages.h"
#include "core/adapters/dds/server/stated_interval.h"

namespace glovebench {

/// A received message, for its line in the log of a server. core/adapters/dds/README.md documents the lines.
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
/// From this line to the next one of its kind the joints are inside the interval, which is rounded outwards.
std::string interval_line(const JointInterval& interval, int64_t time_us, const std::vector<std::string>& names);
/// A server begins. `from`: what says where the joints are.
std::string start_line(int64_t time_us, std::string_view from);

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
/// The last interval of a log, as last_state has the last state. Nothing if there is none, as in logs of older
/// versions. Throws Error naming `path` if it is not one of these joints, or a minimum is above its maximum.
std::optional<JointInterval> last_interval(std::string_view log, const std::vector<std::string>& names,
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

}  // namespace glovebench
