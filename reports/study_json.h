#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/json_cursor.h"
#include "reports/study.h"

namespace glovebench::reports {

/// "studies" in results.json, without times.
nlohmann::ordered_json studies_json(const std::vector<StudyResult>& studies);
/// "studies" in timings.json: tables with a time, reduced to times and naming columns.
nlohmann::ordered_json study_times_json(const std::vector<StudyResult>& studies);

/// Throws: Error for anything that studies_json does not write.
std::vector<StudyResult> read_studies(const JsonCursor& json);

/// Checks invariants: unique names that no other file of a report has, one cell a column, at least one naming
/// column and none of them a time, at most six digits.
void check_studies(const std::vector<StudyResult>& studies);

}  // namespace glovebench::reports
