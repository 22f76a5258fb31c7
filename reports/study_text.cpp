#include "reports/study_text.h"

#include <fmt/format.h>

#include "reports/csv.h"
#include "reports/json_text.h"
#include "reports/study_json.h"

namespace glovebench::reports {
namespace {

/// "0.00" for "-0.00": what rounds to zero has no sign.
std::string without_minus_zero(std::string text) {
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// A bar would end the cell.
std::string escape_bars(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped.append(c == '|' ? "\\|" : std::string(1, c));
  return escaped;
}

std::string table_markdown(const Table& table, const StudyResult& study) {
  TextTable text = study_table(table);
  for (std::string& heading : text.heading) heading = escape_bars(heading);
  for (auto& row : text.rows)
    for (std::string& cell : row) cell = escape_bars(cell);
  const std::string title = table.title == study.title ? "" : fmt::format("### {}\n\n", table.title);
  const std::string explanation = table.explanation.empty() ? "" : table.explanation + "\n\n";
  return title + explanation + to_markdown(text) + "\n";
}

}  // namespace

std::string cell_text(const Cell& cell, const Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<int64_t>(&cell)) return std::to_string(*count);
  if (const auto* number = std::get_if<double>(&cell))
    return without_minus_zero(fmt::format("{:.{}f}", rounded(*number), column.digits));
  return "-";
}

TextTable study_table(const Table& table) {
  TextTable text;
  text.name_columns = table.name_columns;
  for (const Column& column : table.columns) text.heading.push_back(column.heading);
  for (const auto& row : table.rows) {
    text.rows.emplace_back();
    for (size_t c = 0; c < row.size(); ++c) text.rows.back().push_back(cell_text(row[c], table.columns[c]));
  }
  return text;
}

std::string table_file(const Table& table) {
  return "tables/" + table.name + ".csv";
}

std::string table_csv(const Table& table) {
  nlohmann::ordered_json heading = nlohmann::ordered_json::array();
  for (const Column& column : table.columns) heading.push_back(column.key);
  std::string csv = csv_line(heading);
  for (const auto& row : table.rows) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (const Cell& cell : row) cells.push_back(cell_json(cell));
    csv += csv_line(cells);
  }
  return csv;
}

std::string study_markdown(const StudyResult& study) {
  std::string text = fmt::format("## {}\n\n", study.title);
  for (const Table& table : study.tables) text += table_markdown(table, study);
  return text;
}

}  // namespace glovebench::reports
