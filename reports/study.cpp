#include "reports/study.h"

#include <algorithm>

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

}  // namespace glovebench::reports
