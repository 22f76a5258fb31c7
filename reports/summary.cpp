#include "reports/summary.h"

#include <fmt/format.h>

#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

std::string mean_with_interval(const ExperimentResult& experiment, std::string_view metric) {
  const auto& interval = experiment.interval_of(metric);
  const std::string mean = fixed(experiment.aggregate_of(metric).mean, 2);
  return interval ? fmt::format("{} [{:.2f}, {:.2f}]", mean, interval->low, interval->high) : mean;
}

std::string truth_cell(const ExperimentKey& key) {
  const std::string truth(to_string(key.truth));
  if (key.subject == 1) return truth;
  return key.subject == 2 ? truth + ", second subject" : fmt::format("{}, subject {}", truth, key.subject);
}

}  // namespace

Table experiment_table(const std::vector<std::string>& measured) {
  Table table = table_of({"trajectory", "database", "truth", "noise"}, 4);
  for (const std::string& heading : measured) table.columns.push_back({"", heading});
  return table;
}

Row experiment_names(const ExperimentKey& key) {
  return {key.trajectory, key.database, truth_cell(key), fmt::format("{} x {}", key.noise.model, key.noise.factor)};
}

Table detail_summary(const RunResult& result) {
  std::vector<std::string> headings = {"position mm [95%]"};
  for (const Metric& metric : frame_metrics())
    if (!metric.heading.empty()) headings.emplace_back(metric.heading);
  for (const char* heading :
       {"PCK area", "jitter mm", "jitter deg", "latency frames", "lost", "false tracked", "false lost", "frames"})
    headings.emplace_back(heading);
  Table table = experiment_table(headings);
  for (const ExperimentResult& experiment : result.experiments) {
    const Coverage& coverage = experiment.coverage;
    Row& row = table.rows.emplace_back(experiment_names(experiment.key));
    row.push_back(mean_with_interval(experiment, "position_error_mm"));
    for (const Metric& metric : frame_metrics())
      if (!metric.heading.empty()) row.push_back(fixed(experiment.aggregate_of(metric.key).mean, 2));
    row.insert(row.end(),
               {fixed(experiment.pck.area, 3), fixed(experiment.sequence.jitter_position_mm, 2),
                fixed(experiment.sequence.jitter_rotation_deg, 2), fixed(experiment.sequence.latency_frames, 1),
                coverage.lost, coverage.false_tracked, coverage.false_lost, coverage.frames});
  }
  return table;
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

std::string summary_explanation() {
  return "Each cell holds the mean position error (mm), posture error (RMS over the 22 joint angles, degrees) and "
         "rotation error (degrees), then the coverage: the share of all frames, lost ones included, that are "
         "tracked within 50 mm and 30 degrees. Recorded truth is the paper's protocol: a movement that was "
         "tracked once became the truth. Source truth is the movement itself. The tracker's hand model is the "
         "first subject's hand; the second subject's hand differs from it. The paper prints its means for two "
         "experiments only.";
}

std::string quick_note(const RunResult& result) {
  if (!result.configuration.value("quick", false)) return "";
  return "A quick run: a few frames and queries of everything, to see that it runs. Nothing can be concluded from "
         "its "
         "numbers, and no claim is judged.";
}

std::string summary_markdown(const RunResult& result, const PaperNumbers& paper) {
  const NoiseSetting noise = headline_noise(result);
  const std::string note = quick_note(result);
  std::string text =
      fmt::format("# glovebench results\n\nglovebench {}, commit {}, protocol {}.\n\n{}", result.program_version,
                  result.commit, result.protocol.id(), note.empty() ? "" : note + "\n\n");
  text += claims_markdown(judge(claims(), all_measures(result)));
  if (!result.experiments.empty())
    text +=
        fmt::format("## Figure 4\n\n{} Noise: {} x {}.\n\n{}\nThe paper: {}.\n\n", summary_explanation(),
                    noise.model, noise.factor, to_markdown(figure4_summary(result, paper, noise)), paper.source);
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
