#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "core/base/json_cursor.h"
#include "core/robot/command_state.h"
#include "reports/statistics.h"

namespace glovebench::reports {

/// RMS jerk; smaller is smoother (Flash and Hogan 1985).
struct Jerk {
  std::optional<double> joints_deg_s3;
  std::optional<double> position_m_s3;  ///< of the hand's origin

  friend bool operator==(const Jerk&, const Jerk&) = default;
};

/// Differences from the truth's commands.
struct CommandErrors {
  Aggregate joints_deg;  ///< RMS over 24 joints
  Aggregate position_mm;
  Aggregate rotation_deg;  ///< geodesic
  Aggregate arm_deg;       ///< RMS over arm joints, where both exist

  friend bool operator==(const CommandErrors&, const CommandErrors&) = default;
};
struct CommandErrorInfo {
  std::string_view key;  ///< with unit
  std::string_view heading;
  Aggregate CommandErrors::*value;
};
const std::array<CommandErrorInfo, 4>& command_error_infos();

/// Over all seeds.
struct CommandResult {
  int frames = 0;
  std::array<int, kCountOf<CommandState>> sent{};
  std::optional<double> rate_hz;  ///< by time stamps
  std::optional<double> longest_gap_ms;
  Interventions interventions;  ///< of guard and arm
  CommandErrors errors;         ///< of `following` commands
  Jerk jerk, truth_jerk;

  friend bool operator==(const CommandResult&, const CommandResult&) = default;
};

/// "commands" in results.json.
nlohmann::ordered_json commands_json(const CommandResult& commands);
/// Throws: Error.
CommandResult read_commands(const JsonCursor& json);

}  // namespace glovebench::reports
