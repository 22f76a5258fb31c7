#include "eval/stored_study.h"

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/parse_json.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using reports::Cell;
using reports::Column;
using reports::ConfidenceInterval;
using reports::Measure;
using reports::StudyResult;
using reports::Table;

json row_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<int64_t>(&cell)) return *count;
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  return {};
}

Cell cell_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.get<int64_t>();
  if (value.is_number()) return value.get<double>();
  return {};
}

json row_of(const Table& table) {
  json columns = json::array(), rows = json::array();
  for (const Column& column : table.columns)
    columns.push_back({column.key, column.heading, column.digits, column.is_time});
  for (const std::vector<Cell>& row : table.rows) {
    json& cells = rows.emplace_back(json::array());
    for (const Cell& cell : row) cells.push_back(row_of(cell));
  }
  return {table.name, table.title, table.explanation, table.name_columns, std::move(columns), std::move(rows)};
}

Table table_of(const json& row) {
  Table table{row.at(0), row.at(1), row.at(2), {}, row.at(3), {}};
  for (const json& column : row.at(4))
    table.columns.push_back({column.at(0), column.at(1), column.at(2), column.at(3)});
  for (const json& cells : row.at(5)) {
    std::vector<Cell>& cells_of_row = table.rows.emplace_back();
    for (const json& value : cells) cells_of_row.push_back(cell_of(value));
  }
  return table;
}

json row_of(const Measure& measure) {
  json interval;
  if (const auto& i = measure.interval)
    interval = {i->low, i->high, i->level, i->seeds, i->blocks, i->block_frames, i->over};
  return {measure.name, measure.unit, measure.value ? json(*measure.value) : json(), interval, measure.is_time};
}

Measure measure_of(const json& row) {
  Measure measure{row.at(0), row.at(1), {}, {}, row.at(4)};
  if (!row.at(2).is_null()) measure.value = row.at(2).get<double>();
  if (const json& i = row.at(3); !i.is_null())
    measure.interval = ConfidenceInterval{i.at(0), i.at(1), i.at(2), i.at(3), i.at(4), i.at(5), i.at(6)};
  return measure;
}

}  // namespace

std::string to_bytes(const StudyResult& study) {
  json tables = json::array(), measures = json::array();
  for (const Table& table : study.tables) tables.push_back(row_of(table));
  for (const Measure& measure : study.measures) measures.push_back(row_of(measure));
  std::string bytes;
  json::to_cbor(json{study.name, study.title, std::move(tables), std::move(measures)}, bytes);
  return bytes;
}

std::optional<StudyResult> study_from_bytes(const std::string& bytes) {
  try {
    const json content = parse_cbor(bytes, "stored study");
    StudyResult study{content.at(0), content.at(1), {}, {}};
    for (const json& table : content.at(2)) study.tables.push_back(table_of(table));
    for (const json& measure : content.at(3)) study.measures.push_back(measure_of(measure));
    return study;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace glovebench::eval
