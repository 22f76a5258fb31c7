#include "reports/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "reports/statistics.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

/// Cells hold counts, times, errors and changes, which may be negative; sums stay far from overflow.
constexpr double kLargestCell = 1e12;
constexpr size_t kMostCells = 250'000;  // a cell in memory is larger than its text
constexpr int64_t kLargestCount = 1'000'000'000'000;
/// Numbers are written to 1e-6.
constexpr int kMostDigits = 6;

bool is_name(const std::string& name, bool is_measure = false) {
  constexpr size_t kLongest = 80;
  return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || (is_measure && c == '.');
  });
}

/// True if a table's file would be another report's.
bool is_taken(const std::string& name) {
  return name == "figure4" || name == "errors" || name == "figure5" || name == "figure6" || name == "claims" ||
         name == "commands" || name.starts_with("frames_");
}

Json table_json(const Table& table, bool of_times) {
  Json columns = Json::array(), rows = Json::array();
  std::vector<size_t> indices;
  for (size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    if (std::cmp_greater_equal(c, table.name_columns) && column.is_time != of_times) continue;
    columns.push_back({{"key", column.key}, {"heading", column.heading}, {"digits", column.digits}});
    indices.push_back(c);
  }
  for (const Row& row : table.rows) rows.push_back(array_of(indices, [&](size_t c) { return cell_json(row[c]); }));
  return {{"name", table.name},
          {"title", table.title},
          {"explanation", table.explanation},
          {"columns", std::move(columns)},
          {"name_columns", table.name_columns},
          {"rows", std::move(rows)}};
}

Json measures_json(const std::vector<Measure>& measures, bool of_times) {
  Json json = Json::array();
  for (const Measure& measure : measures) {
    if (measure.is_time != of_times) continue;
    json.push_back({{"name", measure.name},
                    {"unit", measure.unit},
                    {"value", rounded_or_null(measure.value)},
                    {"interval", interval_json(measure.interval)}});
  }
  return json;
}

std::string read_key(const JsonCursor& json, bool is_measure = false) {
  const std::string name = json.text();
  if (!is_name(name, is_measure)) json.fail("lower-case letters, digits and underscores");
  return name;
}

Column read_column(const JsonCursor& json) {
  json.expect_keys({"key", "heading", "digits"});
  return {read_key(json["key"]), json["heading"].text(), static_cast<int>(json["digits"].integer(0, kMostDigits)),
          false};
}

Cell read_cell(const JsonCursor& json) {
  if (json.is_null()) return {};
  if (json.is_text()) return json.text();
  if (json.is_integer()) return json.integer(-kLargestCount, kLargestCount);
  return json.number(-kLargestCell, kLargestCell);
}

std::vector<Column> read_columns(const JsonCursor& json) {
  std::vector<Column> columns;
  for (const JsonCursor& item : json.items()) {
    Column column = read_column(item);
    if (std::ranges::find(columns, column.key, &Column::key) != columns.end()) item["key"].fail("each key once");
    columns.push_back(std::move(column));
  }
  if (columns.empty()) json.fail("at least one column");
  return columns;
}

size_t cell_count(const std::vector<StudyResult>& studies) {
  size_t cells = 0;
  for (const StudyResult& study : studies)
    for (const Table& table : study.tables) cells += table.rows.size() * table.columns.size();
  return cells;
}

/// `studies`: earlier ones and the table's own.
Table read_table(const JsonCursor& json, const std::vector<StudyResult>& studies) {
  json.expect_keys({"name", "title", "explanation", "columns", "name_columns", "rows"});
  Table table;
  table.name = read_key(json["name"]);
  if (find_table(studies, table.name) || is_taken(table.name)) json["name"].fail("each table name once");
  table.title = json["title"].text();
  table.explanation = json["explanation"].text();
  table.columns = read_columns(json["columns"]);
  table.name_columns = static_cast<int>(json["name_columns"].integer(1, std::ssize(table.columns)));
  const JsonItems rows = json["rows"].items();
  if (cell_count(studies) + rows.size() * table.columns.size() > kMostCells)
    json["rows"].fail(fmt::format("at most {} cells in all tables", kMostCells));
  for (const JsonCursor& row : rows) {
    const JsonItems cells = row.items();
    if (cells.size() != table.columns.size()) row.fail("one cell for each of columns");
    table.rows.emplace_back().reserve(cells.size());
    for (const JsonCursor& cell : cells) table.rows.back().push_back(read_cell(cell));
  }
  return table;
}

Measure read_measure(const JsonCursor& json, const std::vector<StudyResult>& studies) {
  json.expect_keys({"name", "unit", "value", "interval"});
  Measure measure;
  measure.name = read_key(json["name"], true);
  if (find_measure(studies, measure.name)) json["name"].fail("each measure name once");
  measure.unit = json["unit"].text();
  measure.value = json["value"].number_or_null(-kLargestCell, kLargestCell);
  measure.interval = read_interval(json["interval"], -kLargestCell, kLargestCell);
  return measure;
}

void check_table(const Table& table) {
  check(is_name(table.name) && !is_taken(table.name), "a table's name is that of no other file");
  check(table.name_columns >= 1 && table.name_columns <= std::ssize(table.columns), "columns name a table's rows");
  std::set<std::string> keys;
  for (const Column& column : table.columns) {
    check(is_name(column.key) && keys.insert(column.key).second, "a column's key is a name, and is there once");
    check(column.digits >= 0 && column.digits <= kMostDigits, "a column has at most the digits that files hold");
  }
  for (int c = 0; c < table.name_columns; ++c) check(!table.columns[c].is_time, "no time names a row");
  for (const auto& row : table.rows) check(row.size() == table.columns.size(), "a row has one cell a column");
}

/// Without times, or only the tables and measures that have some.
Json studies_json(const std::vector<StudyResult>& studies, bool of_times) {
  check_studies(studies);
  Json json = Json::array();
  for (const StudyResult& study : studies) {
    Json tables = Json::array(), measures = measures_json(study.measures, of_times);
    for (const Table& table : study.tables)
      if (!of_times || std::ranges::any_of(table.columns, &Column::is_time))
        tables.push_back(table_json(table, of_times));
    if (of_times && tables.empty() && measures.empty()) continue;
    json.push_back({{"name", study.name},
                    {"title", study.title},
                    {"tables", std::move(tables)},
                    {"measures", std::move(measures)}});
  }
  return json;
}

}  // namespace

const Table* find_table(const std::vector<StudyResult>& studies, std::string_view name) {
  for (const StudyResult& study : studies) {
    const auto it = std::ranges::find(study.tables, name, &Table::name);
    if (it != study.tables.end()) return &*it;
  }
  return nullptr;
}

const Measure* find_measure(const std::vector<StudyResult>& studies, std::string_view name) {
  for (const StudyResult& study : studies) {
    const auto it = std::ranges::find(study.measures, name, &Measure::name);
    if (it != study.measures.end()) return &*it;
  }
  return nullptr;
}

void check_studies(const std::vector<StudyResult>& studies) {
  std::set<std::string> tables, measures;
  for (const StudyResult& study : studies) {
    check(is_name(study.name), "a study has a name");
    for (const Table& table : study.tables) {
      check(tables.insert(table.name).second, "a table is there once");
      check_table(table);
    }
    for (const Measure& measure : study.measures)
      check(is_name(measure.name, true) && measures.insert(measure.name).second, "a measure is there once");
  }
}

Json studies_json(const std::vector<StudyResult>& studies) { return studies_json(studies, false); }

Json study_times_json(const std::vector<StudyResult>& studies) { return studies_json(studies, true); }

std::vector<StudyResult> read_studies(const JsonCursor& json) {
  std::vector<StudyResult> studies;
  for (const JsonCursor& item : json.items()) {
    item.expect_keys({"name", "title", "tables", "measures"});
    studies.push_back({read_key(item["name"]), item["title"].text(), {}, {}});
    for (const JsonCursor& table : item["tables"].items())
      studies.back().tables.push_back(read_table(table, studies));
    for (const JsonCursor& measure : item["measures"].items())
      studies.back().measures.push_back(read_measure(measure, studies));
  }
  return studies;
}

}  // namespace glovebench::reports
