#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/tables.h"

namespace glovebench::reports {

/// Rows are experiments; columns for trajectory, database, truth and noise precede `measured`.
Table experiment_table(const std::vector<Column>& measured);
/// The cells of these four columns. `last_subject`: of a row about several.
Row experiment_names(const ExperimentKey& key, std::optional<int> last_subject = {});

/// Position error with interval, and the metrics that have a heading.
Table detail_summary(const RunResult& result);

/// Position, posture, rotation, fingertips, vertices, found and usable of each experiment.
Table headline_table(const RunResult& result);
/// Plain text.
std::string headline_explanation();
/// Names that all experiments share stand above the table.
std::string headline_text(const RunResult& result, size_t columns);
/// LaTeX after a comment that names the run.
std::string errors_latex(const RunResult& result);

/// What Figure 5 was used for, as plain text; empty if it was not run.
std::string figure5_note(const RunResult& result, const PaperNumbers& paper);
/// Plain text; empty unless the run was quick.
std::string quick_note(const RunResult& result);

std::string summary_markdown(const RunResult& result, const PaperNumbers& paper,
                             const std::vector<std::string>& warnings = {});
std::string study_markdown(const StudyResult& study);
/// The same for a terminal. A table that is wider stands there in parts, without the ends of intervals.
std::string study_text(const StudyResult& study, size_t columns);
/// What the tables hold, in plain text.
std::string summary_explanation();

}  // namespace glovebench::reports
