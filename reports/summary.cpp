#include "reports/summary.h"

#include <fmt/format.h>

#include "reports/chart.h"
#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/study_text.h"

namespace glovebench::reports {
namespace {

std::string errors_cell(const ExperimentResult* experiment) {
  if (!experiment || experiment->coverage.frames == 0) return "-";
  return fmt::format("{} / {} / {}, {:.1f}%", fixed(experiment->aggregate_of("position_error_mm").mean, 2),
                     fixed(experiment->aggregate_of("posture_rms_deg").mean, 2),
                     fixed(experiment->aggregate_of("rotation_error_deg").mean, 2),
                     100 * *experiment->coverage.share());
}

std::string mean_with_interval(const ExperimentResult& experiment, std::string_view metric) {
  const auto& interval = experiment.interval_of(metric);
  const std::string mean = fixed(experiment.aggregate_of(metric).mean, 2);
  return interval ? fmt::format("{} [{:.2f}, {:.2f}]", mean, interval->low, interval->high) : mean;
}

}  // namespace

std::string to_markdown(const TextTable& table) {
  std::string text = fmt::format("| {} |\n|", fmt::join(table.heading, " | "));
  for (size_t c = 0; c < table.heading.size(); ++c)
    text += static_cast<int>(c) < table.name_columns ? " --- |" : " ---: |";
  text += "\n";
  for (const auto& row : table.rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

std::string to_html(const TextTable& table) {
  std::string text = "<div class=\"scroll\"><table>\n<thead><tr>";
  const auto cells = [&](const std::vector<std::string>& row, const char* tag) {
    for (size_t c = 0; c < row.size(); ++c)
      text += fmt::format("<{0}{1}>{2}</{0}>", tag,
                          static_cast<int>(c) < table.name_columns ? " class=\"name\"" : "", escape_html(row[c]));
  };
  cells(table.heading, "th");
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    cells(row, "td");
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::vector<std::string> experiment_heading() {
  return {"trajectory", "database", "truth", "noise"};
}

std::string truth_cell(const ExperimentKey& key) {
  const std::string truth(to_string(key.truth));
  if (key.subject == 1) return truth;
  return key.subject == 2 ? truth + ", second subject" : fmt::format("{}, subject {}", truth, key.subject);
}

std::vector<std::string> experiment_cells(const ExperimentKey& key) {
  return {key.trajectory, key.database, truth_cell(key), fmt::format("{} x {}", key.noise.model, key.noise.factor)};
}

TextTable figure4_summary(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  TextTable table;
  table.heading = {"trajectory", "database"};
  for (const Variant& variant : figure4_variants()) table.heading.push_back(variant.title);
  table.heading.push_back("paper");
  for (const Figure4Row& row : figure4_rows(result, paper, noise)) {
    table.rows.push_back({row.trajectory, row.database});
    for (const ExperimentResult* experiment : row.variants) table.rows.back().push_back(errors_cell(experiment));
    table.rows.back().push_back(row.paper ? fmt::format("{:.2f} / {:.2f} / {:.2f}", row.paper->position_mm,
                                                        row.paper->posture_deg, row.paper->rotation_deg)
                                          : "-");
  }
  return table;
}

TextTable detail_summary(const RunResult& result) {
  TextTable table{experiment_heading(), {}, static_cast<int>(experiment_heading().size())};
  table.heading.emplace_back("position mm [95%]");
  for (const Metric& metric : frame_metrics())
    if (!metric.heading.empty()) table.heading.emplace_back(metric.heading);
  for (const char* column :
       {"PCK area", "jitter mm", "jitter deg", "latency frames", "lost", "false tracked", "false lost", "frames"})
    table.heading.emplace_back(column);
  for (const ExperimentResult& experiment : result.experiments) {
    const Coverage& coverage = experiment.coverage;
    std::vector<std::string> row = experiment_cells(experiment.key);
    row.push_back(mean_with_interval(experiment, "position_error_mm"));
    for (const Metric& metric : frame_metrics())
      if (!metric.heading.empty()) row.push_back(fixed(experiment.aggregate_of(metric.key).mean, 2));
    for (std::string cell :
         {fixed(experiment.pck.area, 3), fixed(experiment.sequence.jitter_position_mm, 2),
          fixed(experiment.sequence.jitter_rotation_deg, 2), fixed(experiment.sequence.latency_frames, 1),
          std::to_string(coverage.lost), std::to_string(coverage.false_tracked),
          std::to_string(coverage.false_lost), std::to_string(coverage.frames)})
      row.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
  }
  return table;
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
