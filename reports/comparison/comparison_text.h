#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/comparison/comparison_report.h"
#include "reports/table.h"

namespace glovebench::reports {

// Words, numbers and tables that all forms of a comparison share.

/// "2 worse, 1 better, 33 same, 0 not enough data"; then what got slower, if speed was measured.
std::string outcome_line(const ComparisonReport& report);

/// A row that changed, or that could not be judged, or that stops a change.
bool is_worth_reading(const ComparisonRow& row);

/// The rows in groups of one experiment each, in their order.
std::vector<std::span<const ComparisonRow>> rows_by_experiment(const Comparison& comparison);

/// A name to read: "Tr5 open_power, source, subject 2" for "Tr5_DB_open_power_source_subject2_gradient_1"; the
/// first subject and the paper's noise go without saying. A name of another form stays as it is.
std::string readable_experiment(const std::string& experiment);

/// At most nine characters wide; "-" for none. Signed numbers of zero and more have a plus.
std::string number_text(const std::optional<double>& value);
std::string signed_number_text(const std::optional<double>& value);
/// The verdict; with ", stops" where it does not follow from it that the row stops the change.
std::string verdict_text(const ComparisonRow& row);

/// "2.980 -> 3.400 mm, difference +0.420 [+0.300, +0.540], minimum effect 0.100, 234 of 234 frames"
std::string row_sentence(const ComparisonRow& row);
/// "6.10 times faster than plain, was 8.20, limit 5.74"
std::string speed_sentence(const SpeedRow& row);
/// "NAME: suite quick, glovebench 0.1.0, commit 105ec9a"
std::string result_sentence(const ComparedResult& result);

/// The tone of the row's verdict. Rows that stop the change are `worse`.
Tone tone_of(const ComparisonRow& row);

/// Experiments by readable names, quantities, numbers; the verdict comes last.
Table rows_table(std::span<const ComparisonRow> rows);
/// The tables beside the rows that the report has: speed, configuration, what is not compared, and, for information
/// and explained, the times of the tracker's stages.
std::vector<Table> comparison_tables(const ComparisonReport& report);
/// The verdict, if it comes last, beside the names: a narrow screen or page cuts off numbers, not the answer.
Table verdict_first(Table table);

}  // namespace glovebench::reports
