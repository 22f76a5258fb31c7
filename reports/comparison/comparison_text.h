#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/comparison/comparison_report.h"
#include "reports/table.h"

namespace glovebench::reports {

struct OutcomeCount {
  long count = 0;
  std::string verdict;
  Tone tone;
};
/// Each row counts once. "worse in places" is left out if 0.
std::vector<OutcomeCount> outcome_counts(const Comparison& comparison);
/// "2 worse, 1 worse in places, 1 better, 33 same, 0 not enough data", then whether all is equal, and slower
/// stages.
std::string outcome_line(const ComparisonReport& report);

/// True if the row is changed, not judged, or stopping.
bool is_worth_reading(const ComparisonRow& row);

std::vector<std::span<const ComparisonRow>> rows_by_experiment(const Comparison& comparison);

/// "Tr5 open_power, source, subject 2" for "Tr5_DB_open_power_source_subject2_gradient_1".
std::string readable_experiment(const std::string& experiment);

/// At most nine characters; "-" for none.
std::string number_text(const std::optional<double>& value);
std::string signed_number_text(const std::optional<double>& value);
/// "[-0.120, +0.400]", "-" for none, or "too few frames" if it could not be read.
std::string interval_text(const ComparisonRow& row);
/// "1900 frames of all seeds, or 8 movements". Empty if there is enough data or the need is unknown.
std::string enough_text(const ComparisonRow& row, const CompareConfig& config);
std::string verdict_text(const ComparisonRow& row);

/// "2.980 -> 3.400 mm, difference +0.420 [+0.300, +0.540], minimum effect 0.100, 234 of 234 frames".
std::string row_sentence(const ComparisonRow& row);
/// "6.10 times faster than plain, was 8.20, limit 5.74"
std::string speed_sentence(const SpeedRow& row);
/// "NAME: suite quick, glovebench 0.1.0, commit 105ec9a"
std::string result_sentence(const ComparedResult& result);

/// "intervals hold together with 99%; metrics chosen before: position_error_mm"
std::string method_sentence(const CompareConfig& config, const std::vector<std::string>& preselected);

/// `worse` for rows that stop the change.
Tone tone_of(const ComparisonRow& row);

/// The last column is the verdict.
Table rows_table(std::span<const ComparisonRow> rows);
/// Enough data, speed, configuration, uncompared metrics, stage times.
std::vector<Table> comparison_tables(const ComparisonReport& report);
/// Moves the verdict beside the names, for narrow screens.
Table verdict_first(Table table);

}  // namespace glovebench::reports
