#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_cursor.h"
#include "core/robot/command_state.h"
#include "reports/statistics.h"

namespace glovebench::reports {

/// Root mean square jerk, the third derivative of where something is by time: the smaller, the smoother (Flash and
/// Hogan 1985). Of a hand that is tracked it is mostly noise; what counts is how it compares with the truth's.
struct Jerk {
  std::optional<double> joints_deg_s3;  ///< over the robot hand's 24 joints
  std::optional<double> position_m_s3;  ///< of the hand's origin

  friend bool operator==(const Jerk&, const Jerk&) = default;
};

/// How far commands are from those that the truth would have given.
struct CommandErrors {
  Aggregate joints_deg;    ///< root mean square over the robot hand's 24 joints
  Aggregate position_mm;   ///< of the hand's origin
  Aggregate rotation_deg;  ///< of the hand: geodesic angle
  Aggregate arm_deg;       ///< root mean square over the arm's joints, where both commands have some

  friend bool operator==(const CommandErrors&, const CommandErrors&) = default;
};
struct CommandErrorInfo {
  std::string_view key;  ///< with its unit
  std::string_view heading;
  Aggregate CommandErrors::*value;
};
const std::array<CommandErrorInfo, 4>& command_error_infos();

/// The robot commands of an experiment, of all its seeds.
struct CommandResult {
  int frames = 0;
  std::array<int, kCountOf<CommandState>> sent{};  ///< commands, by their state
  std::optional<double> rate_hz;                   ///< commands a second, by their time stamps
  std::optional<double> longest_gap_ms;            ///< between two commands
  Interventions interventions;                     ///< of the guard and the arm
  CommandErrors errors;                            ///< of those that follow
  Jerk jerk, truth_jerk;

  friend bool operator==(const CommandResult&, const CommandResult&) = default;
};

/// "commands" of an experiment in results.json.
nlohmann::ordered_json commands_json(const CommandResult& commands);
/// Reads it back. Throws Error for whatever commands_json does not write.
CommandResult read_commands(const JsonCursor& json);

}  // namespace glovebench::reports
