#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics.h"
#include "reports/table.h"

namespace glovebench::reports {

/// A number for claims.
struct Measure {
  std::string name;  ///< "figure9.position_rise_share"
  std::string unit;  ///< "mm", "deg"; "": ratio or count
  std::optional<double> value;
  std::optional<ConfidenceInterval> interval;
  bool is_time = false;  ///< see Column

  friend bool operator==(const Measure&, const Measure&) = default;
};

/// A figure of the paper, or a question about it.
struct StudyResult {
  std::string name;   ///< "fig8"
  std::string title;  ///< "Figure 8: matching cascades"
  std::vector<Table> tables;
  std::vector<Measure> measures;

  friend bool operator==(const StudyResult&, const StudyResult&) = default;
};

/// Null without it.
const Table* find_table(const std::vector<StudyResult>& studies, std::string_view name);
const Measure* find_measure(const std::vector<StudyResult>& studies, std::string_view name);

}  // namespace glovebench::reports
