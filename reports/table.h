#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/enum_names.h"
#include "reports/text.h"

namespace glovebench::reports {

struct Column {
  std::string key;       ///< with unit: "posture_error_deg"; may be empty in tables for people
  std::string heading;   ///< with unit, for people
  int digits = 2;        ///< for people
  bool is_time = false;  ///< goes into timings.json, not results.json

  friend bool operator==(const Column&, const Column&) = default;
};

/// Names are CSS classes.
enum class Tone { better, worse, same, unsure };
constexpr auto names_of(Tone) { return std::to_array<std::string_view>({"better", "worse", "same", "unsure"}); }

struct Judgment {
  std::string text;
  Tone tone;

  friend bool operator==(const Judgment&, const Judgment&) = default;
};

/// Monostate: no value.
using Cell = std::variant<std::monostate, std::string, int64_t, double, Judgment>;
using Row = std::vector<Cell>;
Cell cell(const std::optional<double>& value);

struct Table {
  std::string name;  ///< file tables/NAME.csv
  std::string title;
  std::string explanation;  ///< of the columns, plain text
  std::vector<Column> columns;
  int name_columns = 1;  ///< first columns, which name the row
  std::vector<Row> rows;

  friend bool operator==(const Table&, const Table&) = default;
};
Table table_of(const std::vector<std::string>& headings, int name_columns = 1);

/// Throws: std::logic_error for an unknown key.
int column_index(const Table& table, std::string_view key);

/// With the column's digits; "-" without value.
std::string cell_text(const Cell& cell, const Column& column);
/// For JSON and CSV, rounded to 1e-6.
nlohmann::ordered_json cell_json(const Cell& cell);

// All formats escape text.

std::string to_markdown(const Table& table);
/// `plots`: an SVG per row, after the names. `link`: where a heading leads ("#place"), or empty.
std::string to_html(const Table& table, const std::vector<std::string>& plots = {},
                    std::string (*link)(const Column&) = nullptr);
/// A booktabs tabular to \input. `heading`: LaTeX rows above the headings.
std::string to_latex(const Table& table, const std::string& heading = "");
/// The widest columns shrink to fit. `grouped`: the first column becomes a line above its rows.
std::string to_text(const Table& table, bool grouped = false, size_t columns = kTerminalColumns);
void erase_column(Table& table, size_t column);
/// Drops naming columns that are too long for a terminal, but not the first.
Table without_long_names(Table table);
/// Keys, then values to 1e-6. `names`: columns in front, each with one value.
std::string to_csv(const Table& table, const std::vector<std::pair<std::string, std::string>>& names = {});

/// Plain values (RFC 4180 with line feeds); null is empty. An apostrophe precedes text that a spreadsheet would
/// take for a formula.
std::string csv_line(const nlohmann::ordered_json& cells);

}  // namespace glovebench::reports
