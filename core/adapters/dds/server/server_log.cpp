#include "core/adapters/dds/server/server_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/parse_json.h"

namespace glovebench {
namespace {

constexpr double kClockCorrection = 1;  // s
constexpr double kLongestPause = 5;     // s: a server writes a state a second
constexpr std::string_view kEvent = R"({"event":")", kState = R"({"event":"state",)",
                           kInterval = R"({"event":"interval",)";
constexpr double kSteps = 1e6;  // of a degree

/// `round`: to whole steps.
template <typename Round>
std::string angles_text(const std::vector<double>& angles, const std::vector<std::string>& names,
                        const Round& round) {
  std::string text;
  for (size_t j = 0; j < names.size(); ++j) {
    const double angle_deg = round(degrees_from_radians(angles.at(j)) * kSteps) / kSteps + 0.0;  // turns -0 into 0
    text += fmt::format(R"({}"{}":{})", j > 0 ? "," : "", names[j], angle_deg);
  }
  return "{" + text + "}";
}

/// The last complete line that begins so; null if there is none.
nlohmann::json last_line(std::string_view log, std::string_view beginning) {
  size_t end = log.rfind('\n');
  while (end != std::string_view::npos) {
    const size_t before = end == 0 ? std::string_view::npos : log.rfind('\n', end - 1);
    const size_t begin = before == std::string_view::npos ? 0 : before + 1;
    const std::string_view line = log.substr(begin, end - begin);
    if (line.starts_with(beginning)) {
      try {
        return parse_json(line, "log");
      } catch (const Error&) {  // a kill may have cut the line
      }
    }
    end = before;
  }
  return nullptr;
}

std::string duration_text(double seconds) {
  if (seconds < 7200) return fmt::format("{:.1f} s", seconds);
  if (seconds < 48 * 3600) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.1f} days", seconds / 86400);
}

/// The age at `now_us`, negative if the state is later.
double age_s(const LoggedState& state, int64_t now_us) {
  return (static_cast<double>(now_us) - static_cast<double>(state.time_us)) * 1e-6;
}

/// The angles of the joints under a key of a line, rad.
std::vector<double> read_angles(const nlohmann::json& line, const char* key, const std::string& field,
                                const std::vector<std::string>& names, const std::string& path) {
  if (!line.contains(key) || !line[key].is_object())
    throw Error(path, field, fmt::format("no object {}", key), "a line of this server");
  const nlohmann::json& angles = line[key];
  const auto require = [&](bool fine, const std::string& found) {
    if (fine) return;
    throw Error(
        path, field, found,
        fmt::format("the {} joints that are served, and no others. Look where the joints stand; if at rest: "
                    "another --log",
                    names.size()));
  };
  std::vector<double> positions;
  for (const std::string& name : names) {
    require(angles.contains(name) && angles[name].is_number(), "no angle of " + name);
    const double angle_deg = angles[name].get<double>();
    if (!(std::abs(angle_deg) <= 360)) throw Error(path, name, fmt::format("{}", angle_deg), "-360 to 360 degrees");
    positions.push_back(radians_from_degrees(angle_deg));
  }
  require(angles.size() == names.size(), fmt::format("{} joints", angles.size()));
  return positions;
}

}  // namespace

std::string received_line(const ReceivedLine& received) {
  return fmt::format(
      R"({{"event":"received","time_us":{},"topic":"{}","receipt":"{}","stamp_ns":{},"source_us":{}}})",
      received.time_us, received.topic, to_string(received.receipt), received.stamp_ns, received.source_us);
}

std::string state_line(const RobotState& state, int64_t time_us, const std::vector<std::string>& names) {
  return fmt::format(R"({}"time_us":{},"clock_us":{},"state":"{}","position_deg":{}}})", kState, time_us,
                     state.clock_us, to_string(state.state),
                     angles_text(state.position, names, [](double steps) { return std::round(steps); }));
}

std::string interval_line(const JointInterval& interval, int64_t time_us, const std::vector<std::string>& names) {
  return fmt::format(R"({}"time_us":{},"min_deg":{},"max_deg":{}}})", kInterval, time_us,
                     angles_text(interval.min, names, [](double steps) { return std::floor(steps); }),
                     angles_text(interval.max, names, [](double steps) { return std::ceil(steps); }));
}

std::string start_line(int64_t time_us, std::string_view from) {
  return fmt::format(R"({{"event":"start","time_us":{},"from":"{}"}})", time_us, from);
}

std::optional<LoggedState> last_state(std::string_view log, const std::vector<std::string>& names,
                                      const std::string& path) {
  const nlohmann::json state = last_line(log, kState);
  const bool is_log = log.empty() || log.starts_with(kEvent) || log.find(fmt::format("\n{}", kEvent)) != log.npos;
  if (!is_log) throw Error(path, "lines", "none of a log of `robot-server`", "a log, or no file");
  if (state.is_null()) return std::nullopt;
  if (!state.contains("time_us") || !state["time_us"].is_number_integer() || state["time_us"].get<int64_t>() < 0)
    throw Error(path, "last state", "no time_us", "a line of this server");
  return LoggedState{state["time_us"].get<int64_t>(),
                     read_angles(state, "position_deg", "last state", names, path)};
}

std::optional<JointInterval> last_interval(std::string_view log, const std::vector<std::string>& names,
                                           const std::string& path) {
  const nlohmann::json line = last_line(log, kInterval);
  if (line.is_null()) return std::nullopt;
  JointInterval interval{read_angles(line, "min_deg", "last interval", names, path),
                         read_angles(line, "max_deg", "last interval", names, path)};
  for (size_t j = 0; j < names.size(); ++j)
    if (interval.min[j] > interval.max[j])
      throw Error(path, "last interval", "a minimum above the maximum of " + names[j], "a line of this server");
  return interval;
}

std::string age_text(const LoggedState& state, int64_t now_us) {
  const double age = age_s(state, now_us);
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC, {} {}",
                     fmt::gmtime(static_cast<std::time_t>(state.time_us / 1'000'000)), duration_text(std::abs(age)),
                     age < 0 ? "ahead" : "ago");
}

void check_age(const LoggedState& state, int64_t now_us, double max_age_s, const std::string& path) {
  const double age = age_s(state, now_us);
  if (age < -kClockCorrection)
    throw Error(path, "last state", "one of " + age_text(state, now_us),
                "one of the past: set the clock, or give the server another --log to start at rest");
  if (!(age <= max_age_s))
    throw Error(
        path, "last state", "one of " + age_text(state, now_us),
        fmt::format("one of the last {} s: look where the joints stand. If there: a longer --log-age; if at "
                    "rest: another --log",
                    max_age_s));
}

void check_whole(const LoggedState& state, int64_t changed_us, const std::string& path) {
  const double missing = age_s(state, changed_us);
  if (missing > kLongestPause)
    throw Error(
        path, "last state", fmt::format("one {:.1f} s before the file was changed last", missing),
        "the last thing that happened: states after it are lost, as with a full disk. Look where the joints "
        "stand; if at rest: another --log");
}

}  // namespace glovebench
