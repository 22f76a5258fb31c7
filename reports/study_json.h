#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/json_cursor.h"
#include "reports/study.h"

namespace glovebench::reports {

/// What depends on the results alone: "studies" of results.json. Columns and measures that are times are left out.
nlohmann::ordered_json studies_json(const std::vector<StudyResult>& studies);
/// What differs from run to run: "studies" of timings.json. Tables without a time and studies without any are left
/// out; a table that has one keeps the columns that name its rows.
nlohmann::ordered_json study_times_json(const std::vector<StudyResult>& studies);

/// Reads "studies" of results.json back. Throws Error for what studies_json does not write: names that are not
/// lower-case letters, digits and underscores (a table's names a file), or that come twice, rows that do not have
/// one cell a column, cells that are neither text, number nor null.
std::vector<StudyResult> read_studies(const JsonCursor& json);

/// What every writer relies on; anything else is a broken invariant: names as above, each of a table or a measure
/// once in all studies and no other report's file, one cell a column in each row, at least one column that names a
/// row, none of those a time, at most six digits.
void check_studies(const std::vector<StudyResult>& studies);

}  // namespace glovebench::reports
