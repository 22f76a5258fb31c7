#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/comparison/comparison_report.h"
#include "reports/comparison/comparison_text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

/// The interval as a bar over a band of the minimum effect; zero is in the middle, better is left.
std::string interval_plot(const ComparisonRow& row) {
  if (!row.difference || !shows_interval(row)) return "";
  constexpr double kHalf = 60;
  const double reach = 1.1 * std::max({std::abs(*row.low), std::abs(*row.high), std::abs(*row.difference),
                                       row.minimum_effect, 1e-9});
  const auto x = [&](double value) { return kHalf + kHalf * value / reach; };
  return fmt::format(
      "<svg class=\"interval {}\" viewBox=\"0 0 120 14\" width=\"120\" height=\"14\" aria-hidden=\"true\">"
      "<rect class=\"band\" x=\"{:.1f}\" y=\"0\" width=\"{:.1f}\" height=\"14\"/>"
      "<line class=\"zero\" x1=\"60\" y1=\"0\" x2=\"60\" y2=\"14\"/>"
      "<line class=\"bar\" x1=\"{:.1f}\" y1=\"7\" x2=\"{:.1f}\" y2=\"7\"/>"
      "<circle class=\"dot\" cx=\"{:.1f}\" cy=\"7\" r=\"3\"/></svg>",
      to_string(tone_of(row)), x(-row.minimum_effect), x(row.minimum_effect) - x(-row.minimum_effect), x(*row.low),
      x(*row.high), x(*row.difference));
}

/// `of_one`: all rows are of one experiment, whose name is in the heading.
std::string rows_html(std::span<const ComparisonRow> rows, bool of_one) {
  Table table = verdict_first(rows_table(rows));
  if (of_one) erase_column(table, 0);
  std::vector<std::string> plots;
  for (const ComparisonRow& row : rows) plots.push_back(interval_plot(row));
  return to_html(table, plots);
}

std::string table_section(const Table& table) {
  if (table.rows.empty()) return "";
  const std::string explanation =
      table.explanation.empty() ? "" : "<p>" + escape_html(table.explanation) + "</p>\n";
  return fmt::format("<h2>{}</h2>\n{}{}", table.title, explanation, to_html(verdict_first(table)));
}

std::string outcome_tiles(const Comparison& comparison) {
  std::string html = "<div class=\"tiles\">\n";
  for (const auto& [count, verdict, tone] : outcome_counts(comparison))
    html += fmt::format("<div class=\"tile {}\"><b>{}</b>{}</div>\n", glovebench::to_string(tone), count, verdict);
  return html + "</div>\n";
}

bool shows_change(const FrameDifferences::OfMetric& differences) {
  return std::ranges::any_of(differences.values, [](const auto& value) { return value && *value != 0; });
}

/// Differences per frame for the charts, of experiments in which any metric changed.
Table difference_table(const std::vector<FrameDifferences>& experiments) {
  Table table;
  table.columns = {{"experiment", ""}, {"frame", ""}};
  if (!experiments.empty())
    for (const auto& [metric, values] : experiments.front().differences)
      table.columns.push_back({std::string(metric->key), ""});
  for (size_t e = 0; e < experiments.size(); ++e) {
    const auto& differences = experiments[e].differences;
    if (std::ranges::none_of(differences, shows_change)) continue;
    for (size_t f = 0; f < differences.front().values.size(); ++f) {
      Row& row =
          table.rows.emplace_back(Row{static_cast<int64_t>(e), experiments[e].first_frame + static_cast<int>(f)});
      for (const auto& [metric, values] : differences) row.push_back(f < values.size() ? cell(values[f]) : Cell());
    }
  }
  return table;
}

/// Chart of the metrics that changed in some frame. `number`: of the experiment in difference_table.
std::string difference_chart(const FrameDifferences& experiment, std::ptrdiff_t number) {
  std::vector<std::string_view> changed, unchanged;
  for (const auto& differences : experiment.differences)
    (shows_change(differences) ? changed : unchanged).push_back(differences.metric->key);
  std::string html;
  if (!changed.empty())
    html += chart_place(fmt::format("differences {}", number),
                        fmt::format("Differences of {}, frame by frame", fmt::join(changed, ", ")));
  if (!unchanged.empty())
    html += fmt::format("<p class=\"legend\">No frame differs in {}.</p>\n", fmt::join(unchanged, ", "));
  return html;
}

/// Folded if nothing in it is worth reading.
std::string experiment_section(std::span<const ComparisonRow> rows, const std::vector<FrameDifferences>& frames) {
  const std::string& name = rows.front().experiment;
  const auto worse = std::ranges::count_if(rows, stops);
  const auto better = std::ranges::count(rows, Verdict::better, &ComparisonRow::verdict);
  std::string html = fmt::format("<details{}><summary>{}", worse + better > 0 ? " open" : "",
                                 escape_html(readable_experiment(name)));
  if (worse > 0) html += fmt::format(" <span class=\"verdict worse\">{} worse</span>", worse);
  if (better > 0) html += fmt::format(" <span class=\"verdict better\">{} better</span>", better);
  html += "</summary>\n" + rows_html(rows, true);
  const auto differences = std::ranges::find(frames, name, &FrameDifferences::experiment);
  if (differences != frames.end()) html += difference_chart(*differences, differences - frames.begin());
  return html + "</details>\n";
}

std::string experiments_html(const Comparison& comparison) {
  std::string html =
      "<h2>Experiments, frame by frame</h2>\n<p>Differences of each frame, mean over the seeds; above "
      "zero the candidate is worse. Gaps are frames that have no value in one of the two.</p>\n"
      "<noscript><p>The charts are drawn by scripts; comparison.json holds their numbers.</p></noscript>\n";
  for (const auto& rows : rows_by_experiment(comparison))
    if (rows.front().experiment != kAllExperiments) html += experiment_section(rows, comparison.frames);
  return html;
}

Table worst_frames_table(const std::vector<ChangedFrame>& worst) {
  Table table = table_of({"experiment", "frame", "seed", "baseline vertex error mm", "candidate"});
  table.title = "Frames that changed most for the worse";
  for (const ChangedFrame& frame : worst) {
    const auto error = [](const std::optional<double>& value) { return value ? number_text(value) : "lost"; };
    const std::string seed = frame.baseline_seed == frame.candidate_seed
                                 ? std::to_string(frame.baseline_seed)
                                 : fmt::format("{}, candidate {}", frame.baseline_seed, frame.candidate_seed);
    table.rows.push_back({readable_experiment(to_string(frame.key)), frame.frame, seed,
                          error(frame.baseline_vertex_error_mm), error(frame.candidate_vertex_error_mm)});
  }
  return table;
}

std::string rows_section(const Comparison& comparison) {
  std::vector<ComparisonRow> all, changed;
  for (const ComparisonRow& row : comparison.rows)
    if (row.experiment == kAllExperiments)
      all.push_back(row);
    else if (is_worth_reading(row))
      changed.push_back(row);
  std::string html;
  if (!all.empty()) html += "<h2>All experiments</h2>\n" + rows_html(all, true);
  html += "<h2>What changed</h2>\n";
  return html + (changed.empty() ? "<p>Nothing in a single experiment.</p>\n" : rows_html(changed, false));
}

}  // namespace

std::string comparison_page(const ComparisonReport& report) {
  const Comparison& comparison = report.comparison;
  std::string body = fmt::format("<p class=\"provenance\">baseline {}<br/>candidate {}</p>\n",
                                 escape_html(result_sentence(comparison.baseline)),
                                 escape_html(result_sentence(comparison.candidate))) +
                     outcome_tiles(comparison) +
                     fmt::format("<p>{} In the plots the band is the minimum effect, the bar the interval.</p>\n",
                                 escape_html(comparison_explanation(comparison))) +
                     rows_section(comparison);
  for (const Table& table : comparison_tables(report)) body += table_section(table);
  body += table_section(worst_frames_table(comparison.worst)) + picture_section("Pictures", report.pictures) +
          experiments_html(comparison);
  const Table differences = difference_table(comparison.frames);
  std::string scripts;
  if (!differences.rows.empty()) {
    const auto tables = nlohmann::ordered_json::object({{"differences", to_csv(differences)}});
    scripts = chart_scripts(tables, report.scripts);
  }
  return html_document("glovebench comparison", body, "", scripts);
}

}  // namespace glovebench::reports
