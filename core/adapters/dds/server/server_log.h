#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/server/stated_interval.h"

namespace glovebench {

/// A message's log line (core/adapters/dds/README.md).
struct ReceivedLine {
  int64_t time_us = 0;  ///< reception, system time
  std::string_view topic;
  Receipt receipt = Receipt::accepted;
  int64_t stamp_ns = 0;  ///< in the message's header
  int64_t source_us = 0;
};

/// JSON without line end, angles to 1e-6 degrees. `time_us`: system time.
std::string received_line(const ReceivedLine& received);
std::string state_line(const RobotState& state, int64_t time_us, const std::vector<std::string>& names);
/// States that the joints stay in the interval (rounded outward) until the next such line.
std::string interval_line(const JointInterval& interval, int64_t time_us, const std::vector<std::string>& names);
/// `from`: source of the positions.
std::string start_line(int64_t time_us, std::string_view from);

struct LoggedState {
  int64_t time_us = 0;            ///< system time
  std::vector<double> positions;  ///< rad
};
/// The last state in a log's end, in the order of `names`, if any. Ignores cut lines.
/// Throws: Error if it has other joints, or the text is no log.
std::optional<LoggedState> last_state(std::string_view log, const std::vector<std::string>& names,
                                      const std::string& path);
/// The last interval, likewise.
/// Throws: Error if it has other joints, or a minimum above its maximum.
std::optional<JointInterval> last_interval(std::string_view log, const std::vector<std::string>& names,
                                           const std::string& path);
std::string age_text(const LoggedState& state, int64_t now_us);
/// Default of `max_age_s`.
inline constexpr double kMaxLogAge = 600;
/// Throws: Error if the state is older than `max_age_s` or over 1 s in the future.
void check_age(const LoggedState& state, int64_t now_us, double max_age_s, const std::string& path);

/// Throws: Error if the file changed over 5 s after the state: later states are lost.
void check_whole(const LoggedState& state, int64_t changed_us, const std::string& path);

}  // namespace glovebench
