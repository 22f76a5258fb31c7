#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/tables.h"

namespace glovebench::reports {

/// Rows are experiments; columns for trajectory, database, truth and noise precede `measured`.
Table experiment_table(const std::vector<std::string>& measured);
/// The cells of these four columns. `last_subject`: of a row about several.
Row experiment_names(const ExperimentKey& key, std::optional<int> last_subject = {});

/// Position error with interval, metrics without joint convention, jitter, latency, lost and false frames.
Table detail_summary(const RunResult& result);

/// Position, posture, rotation, fingertips, vertices, found and usable of each experiment.
Table headline_table(const RunResult& result);
/// What `headline_table` holds, in plain text.
std::string headline_explanation();
/// The headline for a terminal: names that all experiments share stand above the table.
std::string headline_text(const RunResult& result, size_t columns);
/// The headline as LaTeX, after a comment that names the run.
std::string errors_latex(const RunResult& result);

/// What Figure 5 was used for, as plain text; empty if it was not run.
std::string figure5_note(const RunResult& result, const PaperNumbers& paper);
/// Warning for a quick run, as plain text; else empty.
std::string quick_note(const RunResult& result);

/// summary.md: claims, tables, explanations, studies, robot commands, protocol.
std::string summary_markdown(const RunResult& result, const PaperNumbers& paper);
/// Title, explanation and rows of each table.
std::string study_markdown(const StudyResult& study, std::string (*print)(const Table&) = to_markdown);
/// What the tables hold, in plain text.
std::string summary_explanation();

}  // namespace glovebench::reports
