#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_cursor.h"
#include "reports/statistics.h"
#include "reports/table.h"

namespace glovebench::reports {

struct Measure {
  std::string name;  ///< "figure9.position_rise_share"
  std::string unit;  ///< "mm", "deg"; "": ratio or count
  std::optional<double> value;
  std::optional<ConfidenceInterval> interval;
  bool is_time = false;  ///< see Column

  friend bool operator==(const Measure&, const Measure&) = default;
};

struct StudyResult {
  std::string name;   ///< "fig8"
  std::string title;  ///< "Figure 8: matching cascades"
  std::vector<Table> tables;
  std::vector<Measure> measures;

  friend bool operator==(const StudyResult&, const StudyResult&) = default;
};

/// Null if absent.
const Table* find_table(const std::vector<StudyResult>& studies, std::string_view name);
const Measure* find_measure(const std::vector<StudyResult>& studies, std::string_view name);

/// "studies" in results.json, without times.
nlohmann::ordered_json studies_json(const std::vector<StudyResult>& studies);
/// "studies" in timings.json: naming columns and times.
nlohmann::ordered_json study_times_json(const std::vector<StudyResult>& studies);

/// Throws: Error.
std::vector<StudyResult> read_studies(const JsonCursor& json);

/// Checks: names are unique and no other report file's; one cell per column; at least one naming column, none a
/// time; at most six digits.
/// Throws: std::logic_error.
void check_studies(const std::vector<StudyResult>& studies);

}  // namespace glovebench::reports
