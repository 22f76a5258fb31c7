#include "reports/study.h"

#include <algorithm>

#include "core/base/check.h"

namespace glovebench::reports {

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

int column_index(const Table& table, std::string_view key) {
  const auto it = std::ranges::find(table.columns, key, &Column::key);
  check(it != table.columns.end(), "a table has the column that is asked for");
  return static_cast<int>(it - table.columns.begin());
}

}  // namespace glovebench::reports
