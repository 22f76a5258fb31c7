#include "reports/commands.h"

#include "reports/text.h"

namespace glovebench::reports {

const std::array<CommandErrorInfo, 4>& command_error_infos() {
  static const std::array<CommandErrorInfo, 4> infos = {
      {{"joints_deg", "joints deg", &CommandErrors::joints_deg},
       {"position_mm", "position mm", &CommandErrors::position_mm},
       {"rotation_deg", "rotation deg", &CommandErrors::rotation_deg},
       {"arm_deg", "arm deg", &CommandErrors::arm_deg}}};
  return infos;
}

namespace {

using Json = nlohmann::ordered_json;

/// Jerk and gaps are far larger than errors.
constexpr double kLargest = 1e30;

Json jerk_json(const Jerk& jerk) {
  return {{"joints_deg_s3", rounded_or_null(jerk.joints_deg_s3)},
          {"position_m_s3", rounded_or_null(jerk.position_m_s3)}};
}

Jerk read_jerk(const JsonCursor& json) {
  json.expect_keys({"joints_deg_s3", "position_m_s3"});
  return {json["joints_deg_s3"].number_or_null(0, kLargest), json["position_m_s3"].number_or_null(0, kLargest)};
}

Interventions read_interventions(const JsonCursor& json) {
  Interventions interventions;
  for (const auto& [name, count] : json.members()) {
    const std::optional<Intervention> kind = from_name<Intervention>(name);
    if (!kind) count.fail("a known intervention");
    interventions.add(*kind, count.integer(1, std::numeric_limits<int64_t>::max()));
  }
  return interventions;
}

CommandErrors read_errors(const JsonCursor& json, int followed) {
  if (json.members().size() != command_error_infos().size()) json.fail("as many errors as there are kinds");
  CommandErrors errors;
  for (const CommandErrorInfo& info : command_error_infos()) {
    const JsonCursor item = json[info.key];
    item.expect_keys({"count", "mean", "median", "rms", "p95", "max"});
    errors.*info.value = read_aggregate(item);
    if ((errors.*info.value).count > followed) item["count"].fail("no more than the commands that follow");
  }
  return errors;
}

}  // namespace

Json commands_json(const CommandResult& commands) {
  Json sent = Json::object(), interventions = Json::object(), errors = Json::object();
  for (const CommandState state : all_values<CommandState>())
    sent[std::string(to_string(state))] = commands.sent[static_cast<size_t>(state)];
  for (const Intervention kind : all_values<Intervention>())
    if (commands.interventions[kind] > 0)
      interventions[std::string(to_string(kind))] = commands.interventions[kind];
  for (const CommandErrorInfo& info : command_error_infos())
    errors[std::string(info.key)] = aggregate_json(commands.errors.*info.value);
  return {{"frames", commands.frames},
          {"sent", std::move(sent)},
          {"rate_hz", rounded_or_null(commands.rate_hz)},
          {"longest_gap_ms", rounded_or_null(commands.longest_gap_ms)},
          {"interventions", std::move(interventions)},
          {"errors", std::move(errors)},
          {"jerk", jerk_json(commands.jerk)},
          {"truth_jerk", jerk_json(commands.truth_jerk)}};
}

CommandResult read_commands(const JsonCursor& json) {
  json.expect_keys(
      {"frames", "sent", "rate_hz", "longest_gap_ms", "interventions", "errors", "jerk", "truth_jerk"});
  json["sent"].expect_keys({"following", "holding", "stopped"});
  CommandResult commands;
  commands.frames = json["frames"].count();
  int64_t sent = 0;
  for (const CommandState state : all_values<CommandState>())
    sent += commands.sent[static_cast<size_t>(state)] = json["sent"][to_string(state)].count();
  if (sent > commands.frames) json["sent"].fail("no more commands than frames");
  commands.rate_hz = json["rate_hz"].number_or_null(0, kLargest);
  commands.longest_gap_ms = json["longest_gap_ms"].number_or_null(0, kLargest);
  commands.interventions = read_interventions(json["interventions"]);
  commands.errors = read_errors(json["errors"], commands.sent[static_cast<size_t>(CommandState::following)]);
  commands.jerk = read_jerk(json["jerk"]);
  commands.truth_jerk = read_jerk(json["truth_jerk"]);
  return commands;
}

}  // namespace glovebench::reports
