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

/// Throws: Error for anything that studies_json does not write, e.g. names not of [a-z0-9_] or repeated, rows
/// without one cell per column.
std::vector<StudyResult> read_studies(const JsonCursor& json);

/// Broken invariants of writers: names must be unique, of [a-z0-9_] and no other report's file; rows need one cell
/// per column; a column that is no time must name rows; at most six digits.
void check_studies(const std::vector<StudyResult>& studies);

}  // namespace glovebench::reports
