#include <fmt/format.h>

#include <algorithm>

#include "reports/comparison/comparison_report.h"
#include "reports/comparison/comparison_text.h"

namespace glovebench::reports {
namespace {

/// Names and values from outside: nothing of them is markup, no cell ends early.
std::string escape_markdown(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<')
      escaped += "&lt;";
    else if (c == '&')
      escaped += "&amp;";
    else if (c == '\n' || c == '\r')
      escaped += ' ';
    else if (std::string_view("\\|`*[]").find(c) != std::string_view::npos)
      escaped.append("\\") += c;
    else
      escaped += c;
  }
  return escaped;
}

std::string escaped_table(TextTable table) {
  for (auto& row : table.rows)
    for (std::string& cell : row) cell = escape_markdown(cell);
  return to_markdown(table);
}

/// Bold where it calls for a reader.
std::string rows_markdown(const std::vector<ComparisonRow>& rows) {
  TextTable table = rows_table(rows);
  for (size_t i = 0; i < rows.size(); ++i) {
    for (std::string& cell : table.rows[i]) cell = escape_markdown(cell);
    std::string& verdict = table.rows[i].back();
    if (stops(rows[i]) || rows[i].verdict == Verdict::better) verdict = fmt::format("**{}**", verdict);
  }
  return to_markdown(table);
}

std::string names_markdown(const char* title, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string text = fmt::format("\n{}:\n\n", title);
  for (const std::string& name : names) text += fmt::format("- {}\n", escape_markdown(name));
  return text;
}

}  // namespace

std::string comparison_markdown(const ComparisonReport& report) {
  const Comparison& comparison = report.comparison;
  std::vector<ComparisonRow> shown, rest;
  for (const ComparisonRow& row : comparison.rows)
    (is_worth_reading(row) || row.experiment == kAllExperiments ? shown : rest).push_back(row);
  std::string text = fmt::format("**{}**\n\n- baseline {}\n- candidate {}\n", outcome_line(report),
                                 escape_markdown(result_sentence(comparison.baseline)),
                                 escape_markdown(result_sentence(comparison.candidate)));
  if (!shown.empty()) text.append("\n") += rows_markdown(shown);
  if (!report.speed.empty()) text.append("\n") += escaped_table(speed_table(report.speed));
  if (!comparison.configuration.empty())
    text.append("\n") += escaped_table(configuration_table(comparison.configuration));
  text += names_markdown("Only in the baseline", comparison.only_in_baseline);
  text += names_markdown("Only in the candidate", comparison.only_in_candidate);
  text += names_markdown("Metrics that are not compared", uncompared_texts(comparison));
  if (!report.times.stages.empty())
    text += fmt::format("\n<details><summary>Times</summary>\n\n{}\n{}\n\n</details>\n",
                        escaped_table(times_table(report.times)), times_sentence(report.times));
  if (!rest.empty())
    text += fmt::format("\n<details><summary>{} rows without a change</summary>\n\n{}\n</details>\n", rest.size(),
                        rows_markdown(rest));
  return text.append("\n") + escape_markdown(comparison_explanation(comparison)) + "\n";
}

std::string incomparable_markdown(const std::string& message) {
  return fmt::format("**Not compared**\n\n{}\n", escape_markdown(message));
}

}  // namespace glovebench::reports
