#include "reports/command_tables.h"

#include <fmt/format.h>

#include <numeric>

#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

void add_row(Table& table, const ExperimentKey& key, const Row& cells) {
  Row& row = table.rows.emplace_back(experiment_names(key));
  row.insert(row.end(), cells.begin(), cells.end());
}

/// The kinds that occurred in any experiment.
std::vector<Intervention> interventions_of(const RunResult& result) {
  std::vector<Intervention> kinds;
  for (const Intervention kind : all_values<Intervention>())
    if (std::ranges::any_of(result.experiments, [&](const ExperimentResult& experiment) {
          return experiment.commands && experiment.commands->interventions[kind] > 0;
        }))
      kinds.push_back(kind);
  return kinds;
}

std::string error_cell(const Aggregate& error) {
  return error.count > 0 ? fmt::format("{} ({})", fixed(error.mean, 2), fixed(error.p95, 2)) : "-";
}

std::string jerk_cell(const std::optional<double>& jerk, const std::optional<double>& of_truth, int digits) {
  return jerk ? fmt::format("{} ({})", fixed(jerk, digits), fixed(of_truth, digits)) : "-";
}

}  // namespace

bool has_commands(const RunResult& result) {
  return std::ranges::any_of(result.experiments, [](const ExperimentResult& e) { return e.commands.has_value(); });
}

std::string command_explanation() {
  return "What the robot's hand and arm would have been sent: one command a frame, after the guard. A command "
         "holds while the hand is not tracked and stops after a while; an intervention is what the guard changed "
         "or refused, or a pose that the arm could not reach. Errors are those of the commands that follow, "
         "against the command that the truth would have given by the same mapping, arm and guard, also while the "
         "guard still slows them down on their way back to a hand that was lost: mean and, in brackets, 95th "
         "percentile; joints and arm are the root mean square over their joints. Jerk is the root mean square of "
         "the third derivative by time of commands that follow, in brackets of the truth's at the same times; less "
         "is smoother.";
}

Table command_stream_table(const RunResult& result) {
  Table table = experiment_table({{"frames", "frames"},
                                  {"sent_commands", "sent"},
                                  {"command_rate_hz", "rate Hz (by stamps)"},
                                  {"command_gap_ms", "longest gap ms"},
                                  {"following_commands", "following"},
                                  {"holding_commands", "holding"},
                                  {"stopped_commands", "stopped"}});
  for (const ExperimentResult& experiment : result.experiments) {
    if (!experiment.commands) continue;
    const CommandResult& commands = *experiment.commands;
    Row cells = {commands.frames, std::accumulate(commands.sent.begin(), commands.sent.end(), 0),
                 fixed(commands.rate_hz, 1), fixed(commands.longest_gap_ms, 0)};
    for (const int sent : commands.sent) cells.push_back(sent);
    add_row(table, experiment.key, cells);
  }
  return table;
}

Table command_intervention_table(const RunResult& result) {
  const std::vector<Intervention> kinds = interventions_of(result);
  std::vector<Column> columns;
  for (const Intervention kind : kinds) columns.push_back({"interventions", std::string(to_string(kind))});
  Table table = experiment_table(columns);
  if (kinds.empty()) return table;
  for (const ExperimentResult& experiment : result.experiments) {
    if (!experiment.commands) continue;
    Row cells;
    for (const Intervention kind : kinds) cells.push_back(experiment.commands->interventions[kind]);
    add_row(table, experiment.key, cells);
  }
  return table;
}

Table command_error_table(const RunResult& result) {
  std::vector<Column> columns;
  for (const CommandErrorInfo& info : command_error_infos())
    columns.push_back({fmt::format("command_{}", info.key), std::string(info.heading)});
  columns.insert(columns.end(), {{"jerk_joints_deg_s3", "jerk deg/s³"}, {"jerk_position_m_s3", "jerk m/s³"}});
  Table table = experiment_table(columns);
  for (const ExperimentResult& experiment : result.experiments) {
    if (!experiment.commands) continue;
    const CommandResult& commands = *experiment.commands;
    Row cells;
    for (const CommandErrorInfo& info : command_error_infos())
      cells.push_back(error_cell(commands.errors.*info.value));
    cells.push_back(jerk_cell(commands.jerk.joints_deg_s3, commands.truth_jerk.joints_deg_s3, 0));
    cells.push_back(jerk_cell(commands.jerk.position_m_s3, commands.truth_jerk.position_m_s3, 1));
    add_row(table, experiment.key, cells);
  }
  return table;
}

Table command_latency_table(const RunResult& result, const Timings& timings) {
  Table table = experiment_table({{"", "median ms"}, {"", "p99 ms"}, {"", "longest ms"}});
  for (const ExperimentTiming& timing : timings.experiments) {
    const ExperimentResult* experiment = find_experiment(result, timing.key);
    if (!experiment || timing.command_ms.empty()) continue;
    const std::vector<double>& ms = timing.command_ms;
    add_row(table, timing.key,
            {fixed(percentile(ms, 0.5), 2), fixed(percentile(ms, 0.99), 2), fixed(percentile(ms, 1), 2)});
  }
  return table;
}

std::string commands_csv(const RunResult& result) {
  const std::string run = run_name(result);
  Json heading = experiment_columns();
  heading.push_back("frames");
  for (const CommandState state : all_values<CommandState>()) heading.push_back(to_string(state));
  for (const char* column : {"rate_hz", "longest_gap_ms"}) heading.push_back(column);
  for (const Intervention kind : all_values<Intervention>())
    heading.push_back(fmt::format("interventions_{}", to_string(kind)));
  for (const CommandErrorInfo& info : command_error_infos())
    for (const char* part : {"mean", "p95", "max"}) heading.push_back(fmt::format("{}_{}", info.key, part));
  for (const char* column :
       {"jerk_joints_deg_s3", "truth_jerk_joints_deg_s3", "jerk_position_m_s3", "truth_jerk_position_m_s3"})
    heading.push_back(column);
  std::string csv = csv_line(heading);
  for (const ExperimentResult& experiment : result.experiments) {
    if (!experiment.commands) continue;
    const CommandResult& commands = *experiment.commands;
    Json cells = experiment_cells(run, experiment.key);
    cells.push_back(commands.frames);
    for (const int sent : commands.sent) cells.push_back(sent);
    cells.push_back(rounded_or_null(commands.rate_hz));
    cells.push_back(rounded_or_null(commands.longest_gap_ms));
    for (const Intervention kind : all_values<Intervention>()) cells.push_back(commands.interventions[kind]);
    for (const CommandErrorInfo& info : command_error_infos()) {
      const Aggregate& error = commands.errors.*info.value;
      for (const std::optional<double>& value : {error.mean, error.p95, error.max})
        cells.push_back(rounded_or_null(value));
    }
    for (const std::optional<double>& value : {commands.jerk.joints_deg_s3, commands.truth_jerk.joints_deg_s3,
                                               commands.jerk.position_m_s3, commands.truth_jerk.position_m_s3})
      cells.push_back(rounded_or_null(value));
    csv += csv_line(cells);
  }
  return csv;
}

std::string commands_markdown(const RunResult& result) {
  if (!has_commands(result)) return "";
  const Table interventions = command_intervention_table(result);
  return fmt::format("## Robot commands\n\n{}\n\n{}\n{}\n\n{}\n", command_explanation(),
                     to_markdown(command_stream_table(result)),
                     interventions.rows.empty() ? "Nothing intervened." : to_markdown(interventions),
                     to_markdown(command_error_table(result)));
}

}  // namespace glovebench::reports
