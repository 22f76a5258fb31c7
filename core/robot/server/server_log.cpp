#include "core/robot/server/server_log.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/parse_json.h"

namespace glovebench {
namespace {

constexpr double kClockCorrection = 1;  // s
constexpr double kLongestPause = 5;     // s: a server writes a state a second
constexpr std::string_view kEvent = R"({"event":")", kState = R"({"event":"state",)";

double rounded_deg(double angle) {
  return std::round(degrees_from_radians(angle) * 1e6) / 1e6 + 0.0;  // + 0.0 turns -0 into 0
}

/// The last state that was written as a whole; null if there is none.
nlohmann::json last_state_line(std::string_view log) {
  size_t end = log.rfind('\n');
  while (end != std::string_view::npos) {
    const size_t before = end == 0 ? std::string_view::npos : log.rfind('\n', end - 1);
    const size_t begin = before == std::string_view::npos ? 0 : before + 1;
    const std::string_view line = log.substr(begin, end - begin);
    if (line.starts_with(kState)) {
      try {
        return parse_json(line, "log");
      } catch (const Error&) {  // a kill may have cut it
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

/// How long before `now_us`; negative if after.
double age_s(const LoggedState& state, int64_t now_us) {
  return (static_cast<double>(now_us) - static_cast<double>(state.time_us)) * 1e-6;
}

/// Locks a file, for as long as it is open; a device is everybody's.
void lock_file(int descriptor, const std::string& path) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK)
    throw Error(path, "log", "another server that is writing it", "a log of its own for each server");
  throw Error(path, "log", std::strerror(errno), "a file that can be locked");
}

}  // namespace

std::string received_line(const ReceivedLine& received) {
  return fmt::format(
      R"({{"event":"received","time_us":{},"topic":"{}","receipt":"{}","stamp_ns":{},"source_us":{}}})",
      received.time_us, received.topic, to_string(received.receipt), received.stamp_ns, received.source_us);
}

std::string state_line(const RobotState& state, int64_t time_us, const std::vector<std::string>& names) {
  std::string line = fmt::format(R"({}"time_us":{},"clock_us":{},"state":"{}","position_deg":{{)", kState, time_us,
                                 state.clock_us, to_string(state.state));
  for (size_t j = 0; j < names.size(); ++j)
    line += fmt::format(R"({}"{}":{})", j > 0 ? "," : "", names[j], rounded_deg(state.position.at(j)));
  return line + "}}";
}

std::optional<LoggedState> last_state(std::string_view log, const std::vector<std::string>& names,
                                      const std::string& path) {
  const nlohmann::json state = last_state_line(log);
  const bool is_log = log.empty() || log.starts_with(kEvent) || log.find(fmt::format("\n{}", kEvent)) != log.npos;
  if (!is_log) throw Error(path, "lines", "none of a log of `robot-server`", "a log, or no file");
  if (state.is_null()) return std::nullopt;
  if (!state.contains("position_deg") || !state["position_deg"].is_object())
    throw Error(path, "last state", "no object position_deg", "a line of this server");
  if (!state.contains("time_us") || !state["time_us"].is_number_integer() || state["time_us"].get<int64_t>() < 0)
    throw Error(path, "last state", "no time_us", "a line of this server");
  const nlohmann::json& angles = state["position_deg"];
  std::vector<double> positions;
  for (const std::string& name : names) {
    if (!angles.contains(name) || !angles[name].is_number())
      throw Error(path, "last state", "no angle of " + name, fmt::format("those of its {} joints", names.size()));
    const double angle_deg = angles[name].get<double>();
    if (!(std::abs(angle_deg) <= 360)) throw Error(path, name, fmt::format("{}", angle_deg), "-360 to 360 degrees");
    positions.push_back(radians_from_degrees(angle_deg));
  }
  if (angles.size() != names.size())
    throw Error(path, "last state", fmt::format("{} joints", angles.size()), fmt::format("{}", names.size()));
  return LoggedState{state["time_us"].get<int64_t>(), std::move(positions)};
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

int64_t changed_us(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw Error(path, "log", std::strerror(errno), "a file");
  return int64_t{status.st_mtim.tv_sec} * 1'000'000 + status.st_mtim.tv_nsec / 1000;
}

std::string read_tail(const std::string& path, uint64_t max_bytes) {
  if (!std::filesystem::is_regular_file(path)) return "";
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<int64_t>(file.tellg());
  const int64_t length = std::min(size, static_cast<int64_t>(max_bytes));
  std::string text(static_cast<size_t>(std::max<int64_t>(length, 0)), '\0');
  file.seekg(size - length);
  file.read(text.data(), length);
  if (!file) throw Error(path, "file", "nothing that can be read", "a file");
  return text;
}

GrowingFile::GrowingFile(const std::string& path) {
  if (path.empty()) return;
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw Error(path, "file", std::strerror(errno), "one that can be appended to");
  try {
    lock_file(descriptor_, path);
  } catch (const Error&) {
    close(descriptor_);
    throw;
  }
  char last = '\n';
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  if (size > 0 && pread(descriptor_, &last, 1, size - 1) == 1) cut_ = last != '\n';
}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void GrowingFile::append(const std::string& line) {
  if (descriptor_ < 0) return;
  const std::string whole = (cut_ ? "\n" : "") + line + "\n";
  ssize_t written = -1;
  do {
    written = write(descriptor_, whole.data(), whole.size());
  } while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(whole.size())) {
    cut_ = false;
    return;
  }
  futimens(descriptor_, nullptr);  // takes no room, and tells the next reader that there was more
  if (lost_++ == 0) failure_ = written < 0 ? std::strerror(errno) : "no room for a whole line";
  cut_ = cut_ || written > 0;
}

}  // namespace glovebench
