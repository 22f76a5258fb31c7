#pragma once

#include <string>
#include <vector>

#include "reports/study.h"
#include "reports/summary.h"

namespace glovebench::reports {

/// A cell to read: a number with the column's digits, "-" for none. It rounds what the CSV file holds.
std::string cell_text(const Cell& cell, const Column& column);
/// All columns, times included.
TextTable study_table(const Table& table);

/// The file's name in a run's folder: "tables/figure8.csv".
std::string table_file(const Table& table);
/// All columns, times included; numbers to 1e-6, empty cells for no value.
std::string table_csv(const Table& table);

/// A section for summary.md: of each table title, explanation and rows.
std::string study_markdown(const StudyResult& study);

}  // namespace glovebench::reports
