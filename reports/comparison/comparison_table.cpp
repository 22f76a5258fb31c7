#include <fmt/format.h>

#include <algorithm>

#include "reports/comparison/comparison_report.h"
#include "reports/comparison/comparison_text.h"

namespace glovebench::reports {
namespace {

constexpr size_t kColumns = 120;

/// Of UTF-8 characters, all one column wide here.
size_t width(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });
}

/// Cut in the middle: names differ at their ends.
std::string shortened(const std::string& text, size_t columns) {
  if (width(text) <= columns) return text;
  size_t left = columns / 2, right = text.size() - (columns - 3 - left);
  while (left > 0 && (text[left] & 0xc0) == 0x80) --left;
  while (right < text.size() && (text[right] & 0xc0) == 0x80) ++right;
  return text.substr(0, left) + "..." + text.substr(right);
}

std::string table_line(const std::vector<std::string>& cells) {
  return fmt::format("  {:<27} {:>9} {:>9} {:>10} {:>22} {:>9}  {}\n", cells[0], cells[1], cells[2], cells[3],
                     cells[4], cells[5], cells[6]);
}

std::string group(std::span<const ComparisonRow> rows, bool all_rows) {
  std::string lines;
  for (const ComparisonRow& row : rows)
    if (all_rows || is_worth_reading(row)) lines += table_line(row_cells(row));
  return lines.empty() ? "" : shortened(readable_experiment(rows.front().experiment), kColumns) + "\n" + lines;
}

/// Broken at spaces.
std::string wrapped(const std::string& text) {
  std::string lines;
  size_t column = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = shortened(text.substr(begin, end - begin), kColumns);
    if (column > 0) {
      const bool fits = column + 1 + width(word) <= kColumns;
      lines += fits ? ' ' : '\n';
      column = fits ? column + 1 : 0;
    }
    lines += word;
    column += width(word);
    begin = end + 1;
  }
  return lines + "\n";
}

std::string lines_of(const TextTable& table) {
  std::string lines;
  for (const auto& row : table.rows) {
    std::string line = fmt::format("  {:<42}", shortened(row[0], 42));
    for (size_t c = 1; c < row.size(); ++c) line += fmt::format(" {:>14}", shortened(row[c], 23));
    lines += line + "\n";
  }
  return lines;
}

}  // namespace

std::string comparison_table(const ComparisonReport& report, bool all_rows) {
  const Comparison& comparison = report.comparison;
  std::string text = wrapped("baseline  " + result_sentence(comparison.baseline)) +
                     wrapped("candidate " + result_sentence(comparison.candidate)) + "\n";
  std::string rows;
  for (const auto& experiment : rows_by_experiment(comparison)) rows += group(experiment, all_rows);
  if (!rows.empty()) {
    std::vector<std::string> heading = row_heading();
    heading[5] = "minimum";
    text += table_line(heading) + rows + "\n";
  }
  if (!report.speed.empty())
    text += fmt::format("  {:<42} {:>14} {:>14} {:>14} {:>14}\n", "times faster than plain", "baseline",
                        "candidate", "at best", "limit") +
            lines_of(speed_table(report.speed)) + "\n";
  if (!report.times.stages.empty())
    text += fmt::format("  {:<42} {:>14} {:>14}\n", "median time of a stage", "baseline (ms)", "candidate (ms)") +
            lines_of(times_table(report.times)) + wrapped(times_sentence(report.times)) + "\n";
  if (!comparison.configuration.empty())
    text +=
        "configuration, baseline and candidate\n" + lines_of(configuration_table(comparison.configuration)) + "\n";
  for (const auto& [names, side] :
       {std::pair{&comparison.only_in_baseline, "baseline"}, std::pair{&comparison.only_in_candidate, "candidate"}})
    if (!names->empty()) text += wrapped(fmt::format("only in the {}: {}", side, fmt::join(*names, " ")));
  if (!comparison.uncompared_metrics.empty())
    text += wrapped(fmt::format("not compared: {}", fmt::join(uncompared_texts(comparison), ", ")));
  return text + wrapped(comparison_explanation(comparison)) + outcome_line(report) + "\n";
}

}  // namespace glovebench::reports
