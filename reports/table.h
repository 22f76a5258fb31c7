#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/enum_names.h"

namespace glovebench::reports {

/// A column of a table.
struct Column {
  std::string key;      ///< in CSV and JSON, with its unit: "posture_error_deg"; empty in tables that are only read
  std::string heading;  ///< in tables to read, with its unit
  int digits = 2;       ///< of a number in tables to read; CSV and JSON have more
  bool is_time = false;  ///< differs from run to run: such columns stand in timings.json, not in results.json

  friend bool operator==(const Column&, const Column&) = default;
};

/// How good a verdict is. The names are classes of the page's style.
enum class Tone { better, worse, same, unsure };
constexpr auto names_of(Tone) {
  return std::to_array<std::string_view>({"better", "worse", "same", "unsure"});
}

/// A verdict in a table.
struct Judgment {
  std::string text;
  Tone tone;

  friend bool operator==(const Judgment&, const Judgment&) = default;
};

/// Empty where there is no such value.
using Cell = std::variant<std::monostate, std::string, int64_t, double, Judgment>;
using Row = std::vector<Cell>;
Cell cell(const std::optional<double>& value);

/// Rows and columns, for every format of a report. A row has one cell a column.
struct Table {
  std::string name;         ///< of its file: "figure8" is tables/figure8.csv
  std::string title;        ///< to read
  std::string explanation;  ///< what the columns mean, in a sentence or two of plain text
  std::vector<Column> columns;
  int name_columns = 1;  ///< the first columns name a row, the others measure it
  std::vector<Row> rows;

  friend bool operator==(const Table&, const Table&) = default;
};
/// A table that is only read, still without rows.
Table table_of(const std::vector<std::string>& headings, int name_columns = 1);

/// The index of the column of that key; a key that does not exist is a broken invariant.
int column_index(const Table& table, std::string_view key);

/// A cell to read: a number with the column's digits, "-" for none. It rounds what the CSV file holds.
std::string cell_text(const Cell& cell, const Column& column);
/// A cell as JSON and CSV hold it: numbers rounded to 1e-6.
nlohmann::ordered_json cell_json(const Cell& cell);

// Each format has all columns, times included, and escapes all texts.

/// Verdicts that are better or worse are bold.
std::string to_markdown(const Table& table);
/// `plots` are SVG, one a row, and stand behind the names.
std::string to_html(const Table& table, const std::vector<std::string>& plots = {});
/// A tabular (package booktabs) to \input. The rows of `heading` are LaTeX and stand above the table's own heading,
/// e.g. to span columns.
std::string to_latex(const Table& table, const std::string& heading = "");
/// Aligned text for a terminal: the widest columns are narrower where a line has no room. `grouped`: the first
/// column's text stands in a line above its rows.
std::string to_text(const Table& table, bool grouped = false);
/// Keys, then values: numbers to 1e-6, empty cells for no value.
std::string to_csv(const Table& table);

/// An array of plain values as a line of a CSV file (RFC 4180, but with a line feed): null is an empty cell, texts
/// with a comma, a quote or a line break are quoted. A text that a spreadsheet would take for a formula (it begins
/// with '=', '+', '-', '@', a tab or a line break, and is no number) has an apostrophe before it.
std::string csv_line(const nlohmann::ordered_json& cells);

}  // namespace glovebench::reports
