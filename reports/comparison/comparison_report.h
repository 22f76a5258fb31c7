#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/gate_rule.h"
#include "reports/comparison/stage_times.h"
#include "reports/page/page_frame.h"

namespace glovebench::reports {

struct ComparisonReport {
  Comparison comparison;
  std::vector<SpeedRow> speed;    ///< empty if not measured
  StageTimeChanges times;         ///< empty without times
  std::vector<Picture> pictures;  ///< of the worst frames
  /// As in PageMaterial.
  std::vector<std::string> scripts;
};

/// For a terminal: changed rows or all, then counts of verdicts.
std::string comparison_table(const ComparisonReport& report, bool all_rows, size_t columns = kTerminalColumns);
std::string comparison_markdown(const ComparisonReport& report);
std::string comparison_json(const ComparisonReport& report);  ///< reports/schema/comparison.schema.json
std::string comparison_csv(const ComparisonReport& report);
std::string comparison_latex(const ComparisonReport& report);
/// A suite per experiment, a case per metric and speed ratio. A case fails if it stops the change, and is skipped
/// without enough data.
std::string comparison_junit(const ComparisonReport& report);
/// One case with an error.
std::string incomparable_junit(const std::string& message);
std::string incomparable_markdown(const std::string& message);
std::string comparison_page(const ComparisonReport& report);

/// Throws: Error if the folder holds a run or baseline, or as require_own_files. The functions below call this.
void require_own_folder(const std::string& folder,
                        std::initializer_list<const char*> names = {"junit.xml", "index.html"});

/// Writes a comparison's files (reports/README.md) as one set (core/base/file_set.h). Returns their names.
/// Throws: Error.
std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report);
/// Throws: Error.
void remove_comparison(const std::string& folder);
/// Writes comparison.md and junit.xml, and removes an earlier comparison's other files.
void write_refusal(const std::string& folder, const std::string& message);

}  // namespace glovebench::reports
