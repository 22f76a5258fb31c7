#include "reports/comparison/comparison_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <sstream>

#include "core/base/file_set.h"
#include "reports/comparison/comparison_text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr const char *kJson = "comparison.json", *kMarkdown = "comparison.md", *kCsv = "comparison.csv",
                     *kLatex = "comparison.tex", *kJunit = "junit.xml", *kPage = "index.html";
constexpr const char* kFiles[] = {kJson, kMarkdown, kCsv, kLatex, kJunit, kPage};

std::string folded(const std::string& summary, const std::string& content) {
  return fmt::format("\n<details><summary>{}</summary>\n\n{}\n</details>\n", summary, content);
}

/// On a narrow terminal without two columns, which the report's files have.
std::string rows_text(std::span<const ComparisonRow> rows, size_t columns) {
  Table table = rows_table(rows);
  const auto fits = [&] {
    std::istringstream lines(to_text(table, true, std::numeric_limits<int>::max()));
    size_t widest = 0;
    for (std::string line; std::getline(lines, line);) widest = std::max(widest, line.size());
    return widest <= columns;
  };
  for (const char* heading : {"minimum effect", "candidate"})
    if (!fits())
      erase_column(table, std::ranges::find(table.columns, heading, &Column::heading) - table.columns.begin());
  return to_text(table, true, columns);
}

}  // namespace

std::string comparison_table(const ComparisonReport& report, bool all_rows, size_t columns) {
  const Comparison& comparison = report.comparison;
  std::vector<ComparisonRow> shown;
  for (const ComparisonRow& row : comparison.rows)
    if (all_rows || is_worth_reading(row)) shown.push_back(row);
  std::string text = wrapped("baseline  " + result_sentence(comparison.baseline), columns) +
                     wrapped("candidate " + result_sentence(comparison.candidate), columns) + "\n";
  if (!shown.empty()) text += rows_text(shown, columns) + "\n";
  for (const Table& table : comparison_tables(report))
    text += to_text(table, table.columns.front().heading == "experiment", columns) +
            (table.explanation.empty() ? "" : wrapped(table.explanation, columns)) + "\n";
  return text + wrapped(comparison_explanation(comparison), columns) + wrapped(outcome_line(report), columns);
}

std::string comparison_markdown(const ComparisonReport& report) {
  const Comparison& comparison = report.comparison;
  std::vector<ComparisonRow> shown, rest;
  for (const ComparisonRow& row : comparison.rows)
    (is_worth_reading(row) || row.experiment == kAllExperiments ? shown : rest).push_back(row);
  std::string text = fmt::format("**{}**\n\n- baseline {}\n- candidate {}\n", outcome_line(report),
                                 escape_markdown(result_sentence(comparison.baseline)),
                                 escape_markdown(result_sentence(comparison.candidate)));
  if (!shown.empty()) text += "\n" + to_markdown(rows_table(shown));
  for (const Table& table : comparison_tables(report))
    text += table.explanation.empty()
                ? "\n" + to_markdown(table)
                : folded(table.title, fmt::format("{}\n{}\n", to_markdown(table), table.explanation));
  if (!rest.empty())
    text += folded(counted(rest.size(), "row") + " without a change", to_markdown(rows_table(rest)));
  return text + "\n" + escape_markdown(comparison_explanation(comparison)) + "\n";
}

std::string incomparable_markdown(const std::string& message) {
  return fmt::format("**Not compared**\n\n{}\n", escape_markdown(message));
}

std::string comparison_latex(const ComparisonReport& report) {
  const Comparison& comparison = report.comparison;
  const auto named = [](const char* side, const ComparedResult& result) {
    return latex_comment(fmt::format("{} {}, run {}", side, result_sentence(result), result.run));
  };
  return named("baseline", comparison.baseline) + named("candidate", comparison.candidate) +
         latex_comment(method_sentence(comparison.config, comparison.preselected)) +
         to_latex(verdict_first(rows_table(comparison.rows)));
}

void require_own_folder(const std::string& folder, std::initializer_list<const char*> names) {
  if (std::filesystem::exists(folder + "/results.json"))
    throw Error("--output", "folder", folder + ", which holds a run or a baseline",
                "another: both have an index.html");
  require_own_files(folder, names);
}

std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report) {
  require_own_folder(folder);
  WholeFiles files(folder);
  files.add(kJson, comparison_json(report));
  files.add(kMarkdown, comparison_markdown(report));
  files.add(kCsv, comparison_csv(report));
  files.add(kLatex, comparison_latex(report));
  files.add(kJunit, comparison_junit(report));
  files.add(kPage, comparison_page(report));
  files.commit();
  return files.names();
}

void remove_comparison(const std::string& folder) {
  if (!std::filesystem::exists(folder)) return;
  require_own_folder(folder);
  WholeFiles files(folder);
  for (const char* name : kFiles) files.remove(name);
  files.commit();
}

void write_refusal(const std::string& folder, const std::string& message) {
  require_own_folder(folder);
  WholeFiles files(folder);
  for (const char* name : kFiles) files.remove(name);
  files.add(kMarkdown, incomparable_markdown(message));
  files.add(kJunit, incomparable_junit(message));
  files.commit();
}

}  // namespace glovebench::reports
