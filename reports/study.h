#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "reports/statistics.h"

namespace glovebench::reports {

/// A column of a study's table.
struct Column {
  std::string key;       ///< in CSV and JSON, with its unit: "posture_error_deg"
  std::string heading;   ///< in tables to read, with its unit
  int digits = 2;        ///< of a number in tables to read; CSV and JSON have more
  bool is_time = false;  ///< differs from run to run: such columns stand in timings.json, not in results.json

  friend bool operator==(const Column&, const Column&) = default;
};

/// Empty where there is no such value.
using Cell = std::variant<std::monostate, std::string, int64_t, double>;

/// A table of numbers: what a figure of the paper shows, or what it does not show. Rows are in reading order.
struct Table {
  std::string name;         ///< of its file: "figure8" is tables/figure8.csv
  std::string title;        ///< to read
  std::string explanation;  ///< what the columns mean, in a sentence or two of plain text
  std::vector<Column> columns;
  int name_columns = 1;  ///< the first columns name a row, the others measure it
  std::vector<std::vector<Cell>> rows;

  friend bool operator==(const Table&, const Table&) = default;
};

/// A number that a claim may be about.
struct Measure {
  std::string name;  ///< "figure9.position_rise_share"
  std::string unit;  ///< "mm", "deg", "" for a ratio or a count
  std::optional<double> value;
  std::optional<ConfidenceInterval> interval;
  bool is_time = false;  ///< as of a column

  friend bool operator==(const Measure&, const Measure&) = default;
};

/// What one study of a reproduction found: a figure of the paper, or a question about it.
struct StudyResult {
  std::string name;   ///< "fig8"
  std::string title;  ///< "Figure 8: matching cascades"
  std::vector<Table> tables;
  std::vector<Measure> measures;

  friend bool operator==(const StudyResult&, const StudyResult&) = default;
};

/// Null if there is none of that name.
const Table* find_table(const std::vector<StudyResult>& studies, std::string_view name);
const Measure* find_measure(const std::vector<StudyResult>& studies, std::string_view name);
/// The index of the column of that key; a key that does not exist is a broken invariant.
int column_index(const Table& table, std::string_view key);

}  // namespace glovebench::reports
