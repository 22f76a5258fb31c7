#include "reports/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>

#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/terminal_table.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

std::string mean_with_interval(const ExperimentResult& experiment, std::string_view metric) {
  const auto& interval = experiment.interval_of(metric);
  const std::string mean = fixed(experiment.aggregate_of(metric).mean, 2);
  return interval ? fmt::format("{} [{:.2f}, {:.2f}]", mean, interval->low, interval->high) : mean;
}

/// Makes one column of all names.
void join_names(Table& table) {
  const auto count = static_cast<size_t>(table.name_columns);
  for (Row& row : table.rows) {
    std::string name;
    for (size_t c = 0; c < count; ++c) name += (c > 0 ? ", " : "") + cell_text(row[c], table.columns[c]);
    row.erase(row.begin() + 1, row.begin() + table.name_columns);
    row.front() = name;
  }
  table.columns.erase(table.columns.begin() + 1, table.columns.begin() + table.name_columns);
  table.name_columns = 1;
}

Cell metric_cell(const ExperimentResult& experiment, const Column& column) {
  return fixed(value_of(metric_of(column.key), experiment), column.digits);
}

std::string truth_cell(const ExperimentKey& key, std::optional<int> last_subject) {
  std::string truth(to_string(key.truth));
  if (key.appearance == Appearance::skin) truth += ", bare hand";
  if (last_subject.value_or(key.subject) != key.subject)
    return fmt::format("{}, subjects {} to {}", truth, key.subject, *last_subject);
  if (key.subject == 1) return truth;
  return key.subject == 2 ? truth + ", second subject" : fmt::format("{}, subject {}", truth, key.subject);
}

}  // namespace

Table experiment_table(const std::vector<Column>& measured) {
  Table table = table_of({"trajectory", "database", "truth", "noise"}, 4);
  table.columns.insert(table.columns.end(), measured.begin(), measured.end());
  return table;
}

Row experiment_names(const ExperimentKey& key, std::optional<int> last_subject) {
  return {key.trajectory, key.database, truth_cell(key, last_subject),
          fmt::format("{} x {}", key.noise.model, key.noise.factor)};
}

Table detail_summary(const RunResult& result) {
  std::vector<Column> columns = {{"position_error_mm", "position mm [95%]"}};
  for (const Metric& metric : metrics())
    if (!metric.heading.empty())
      columns.push_back({std::string(metric.key), std::string(metric.heading), metric.digits});
  Table table = experiment_table(columns);
  for (const ExperimentResult& experiment : result.experiments) {
    Row& row = table.rows.emplace_back(experiment_names(experiment.key));
    row.push_back(mean_with_interval(experiment, columns.front().key));
    for (const Column& column : std::span(columns).subspan(1)) row.push_back(metric_cell(experiment, column));
  }
  return table;
}

Table headline_table(const RunResult& result) {
  const std::vector<Column> columns = {
      {"position_error_mm", "position mm"},   {"posture_rms_deg", "posture deg"},
      {"rotation_error_deg", "rotation deg"}, {"fingertip_error_mm", "fingertips mm"},
      {"vertex_error_mm", "vertices mm"},     {"found_percent", "found %", 1},
      {"usable_percent", "usable %", 1}};
  Table table = experiment_table(columns);
  for (const ExperimentResult& experiment : result.experiments) {
    Row& row = table.rows.emplace_back(experiment_names(experiment.key));
    for (const Column& column : columns) row.push_back(metric_cell(experiment, column));
  }
  return table;
}

std::string headline_explanation() {
  return "Mean errors of the tracked frames: position, posture (RMS over the 22 joint angles), rotation, "
         "fingertips, vertices. Of the frames in which at least 30% of the hand is visible, lost ones included: "
         "found within 50 mm and 30 degrees; usable within 10 mm and 10 degrees, fingertips within 20 mm.";
}

std::string headline_text(const RunResult& result, size_t columns) {
  constexpr size_t kMostNames = 2;  // more make a line of their own above the numbers
  Table table = headline_table(result);
  const std::vector<std::string> common = remove_common_names(table);
  const std::vector<std::string> short_headings = {"pos. mm",  "post. deg", "rot. deg", "tips mm",
                                                   "vert. mm", "found %",   "usable %"};
  for (size_t c = 0; c < short_headings.size(); ++c)
    table.columns[static_cast<size_t>(table.name_columns) + c].heading = short_headings[c];
  const bool is_grouped = static_cast<size_t>(table.name_columns) > kMostNames;
  if (is_grouped) join_names(table);
  std::string text = wrapped(headline_explanation(), columns);
  if (!common.empty()) text += wrapped(fmt::format("All: {}.", fmt::join(common, ", ")), columns);
  return text + "\n" + to_text(table, is_grouped, columns);
}

std::string errors_latex(const RunResult& result) {
  return latex_comment(fmt::format("glovebench run {}: mean errors", run_name(result))) +
         to_latex(headline_table(result));
}

std::string study_markdown(const StudyResult& study) {
  std::string text = fmt::format("## {}\n\n", study.title);
  for (const Table& table : study.tables) {
    if (table.title != study.title) text += fmt::format("### {}\n\n", table.title);
    if (!table.explanation.empty()) text += table.explanation + "\n\n";
    text += to_markdown(table) + "\n";
  }
  return text;
}

std::string study_text(const StudyResult& study, size_t columns) {
  std::string text = study.title + "\n\n";
  for (const Table& table : study.tables) {
    if (table.title != study.title) text += wrapped(table.title, columns) + "\n";
    if (!table.explanation.empty()) text += wrapped(table.explanation, columns) + "\n";
    text += to_terminal(without_long_names(table), columns) + "\n";
  }
  return text;
}

std::string summary_explanation() {
  return "Each cell holds the mean position error (mm), posture error (RMS over the 22 joint angles, degrees) and "
         "rotation error (degrees), then the coverage: the share of all frames, lost ones included, that are "
         "tracked within 50 mm and 30 degrees. Recorded truth is the paper's protocol: a movement that was "
         "tracked once became the truth. Source truth is the movement itself. The tracker's hand model is the "
         "first subject's hand; the second subject's hand differs from it. The paper prints its means for two "
         "experiments only.";
}

std::string figure5_note(const RunResult& result, const PaperNumbers& paper) {
  const auto& [trajectory, database, mean, frames] = paper.figure_5;
  if (!find_experiment(result, {trajectory, database, TruthKind::recorded, 1, headline_noise(result)})) return "";
  return fmt::format(
      "Figure 5 ({} with {}) is a calibration, not evidence: the movement has the length and onsets of the printed "
      "curve, and the filter and the distance from open hand to power grasp were read off it.",
      trajectory, database);
}

std::string quick_note(const RunResult& result) {
  if (!result.configuration.value("quick", false)) return "";
  return "A quick run: a few frames and queries of everything, to see that it runs. Nothing can be concluded from "
         "its numbers, and no claim is judged.";
}

std::string summary_markdown(const RunResult& result, const PaperNumbers& paper,
                             const std::vector<std::string>& warnings) {
  const NoiseSetting noise = headline_noise(result);
  const std::string note = quick_note(result);
  std::string text = fmt::format("# glovebench results\n\nglovebench {}, commit {}, protocol {}, run {}.\n\n{}",
                                 result.program_version, result.commit, result.protocol.id(), run_name(result),
                                 note.empty() ? "" : note + "\n\n");
  for (const std::string& warning : warnings) text += "**Warning:** " + escape_markdown(warning) + "\n\n";
  text += claims_markdown(judge(claims(), all_measures(result)));
  if (is_figure4(result))
    text +=
        fmt::format("## Figure 4\n\n{} Noise: {} x {}.\n\n{}\nThe paper: {}.\n\n", summary_explanation(),
                    noise.model, noise.factor, to_markdown(figure4_summary(result, paper, noise)), paper.source);
  if (const std::string calibration = figure5_note(result, paper); !calibration.empty())
    text += calibration + "\n\n";
  if (!result.experiments.empty())
    text +=
        fmt::format("## Mean errors\n\n{}\n\n{}\n", headline_explanation(), to_markdown(headline_table(result)));
  for (const StudyResult& study : result.studies) text += study_markdown(study);
  if (!result.experiments.empty())
    text += fmt::format(
        "## More metrics\n\nIntervals are over blocks of frames and, where there are several, noise "
        "seeds; not over movements or hands.\n\n{}",
        to_markdown(detail_summary(result)));
  if (has_commands(result)) text.append("\n") += commands_markdown(result);
  return text;
}

}  // namespace glovebench::reports
