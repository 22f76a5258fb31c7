#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/tables.h"

namespace glovebench::reports {

/// Rows are experiments; columns for trajectory, database, truth and noise precede `measured`.
Table experiment_table(const std::vector<Column>& measured);
/// Cells of these four columns. `last_subject`: of a row about several.
Row experiment_names(const ExperimentKey& key, std::optional<int> last_subject = {});

/// Position error with interval, and metrics with a heading.
Table detail_summary(const RunResult& result);

/// Position, posture, rotation, fingertips, vertices, found and usable.
Table headline_table(const RunResult& result);
/// Plain text.
std::string headline_explanation();
/// Names that all experiments share stand above the table.
std::string headline_text(const RunResult& result, size_t columns);
/// A LaTeX comment names the run.
std::string errors_latex(const RunResult& result);

/// What Figure 5 was used for, in plain text; empty if not run.
std::string figure5_note(const RunResult& result, const PaperNumbers& paper);
/// Plain text; empty unless the run was quick.
std::string quick_note(const RunResult& result);

std::string summary_markdown(const RunResult& result, const PaperNumbers& paper,
                             const std::vector<std::string>& warnings = {});
std::string study_markdown(const StudyResult& study);
/// Tables wider than `columns` stand in parts, without the ends of intervals.
std::string study_text(const StudyResult& study, size_t columns);
/// Plain text.
std::string summary_explanation();

}  // namespace glovebench::reports
