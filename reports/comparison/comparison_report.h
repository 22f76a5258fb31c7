#pragma once

#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/gate_rule.h"
#include "reports/comparison/stage_times.h"
#include "reports/page/page_frame.h"

namespace glovebench::reports {

/// A comparison with what belongs to its report.
struct ComparisonReport {
  Comparison comparison;
  std::vector<SpeedRow> speed;    ///< empty where none was measured
  StageTimeChanges times;         ///< for information; empty where a run has none
  std::vector<Picture> pictures;  ///< of the worst frames
  /// Vega, Vega-Lite and Vega-Embed, in that order, which draw the page's charts; without them it has its tables.
  std::vector<std::string> scripts;
};

/// For a terminal: at most 120 columns. Rows that are neither "same" nor unchanged, or all of them; then a line
/// that counts the verdicts.
std::string comparison_table(const ComparisonReport& report, bool all_rows);
/// For a job summary or a pull request's comment: the verdict first.
std::string comparison_markdown(const ComparisonReport& report);
std::string comparison_json(const ComparisonReport& report);  ///< reports/schema/comparison.schema.json
std::string comparison_csv(const ComparisonReport& report);
std::string comparison_latex(const ComparisonReport& report);  ///< a tabular (booktabs), to \input
/// JUnit XML: a test suite for each experiment, a case for each metric, one for each speed ratio. A case fails if
/// it stops the change (gate_rule.h), and is skipped where there is not enough data.
std::string comparison_junit(const ComparisonReport& report);
/// The same for results that could not be compared: one case with an error.
std::string incomparable_junit(const std::string& message);
std::string incomparable_markdown(const std::string& message);
std::string comparison_page(const ComparisonReport& report);

/// Throws Error if the folder holds a run or a baseline: both have an index.html. So do the three functions below.
void require_own_folder(const std::string& folder);

/// Writes comparison.json, .md, .csv, .tex, junit.xml and index.html, one set of files (core/base/file_set.h), and
/// returns their names. Throws Error if the folder cannot be written.
std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report);
/// Removes these files of an earlier comparison: no reader takes them for those of one that failed since. Throws
/// Error.
void remove_comparison(const std::string& folder);
/// Writes what stands in the place of a comparison that could not be made: comparison.md and junit.xml with the
/// message. The other files of an earlier one go.
void write_refusal(const std::string& folder, const std::string& message);

}  // namespace glovebench::reports
