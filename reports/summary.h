#pragma once

#include <string>
#include <vector>

#include "reports/tables.h"

namespace glovebench::reports {

/// A table whose rows are experiments: trajectory, database, truth and noise name them, before these columns.
Table experiment_table(const std::vector<std::string>& measured);
/// The cells that name an experiment in it.
Row experiment_names(const ExperimentKey& key);

/// One row an experiment, of any noise: the mean position error with its interval, the metrics that depend on no
/// joint convention, jitter, latency, lost and false frames.
Table detail_summary(const RunResult& result);

/// What to know of a quick run before its numbers, as plain text; empty for any other.
std::string quick_note(const RunResult& result);

/// summary.md: what became of the paper's claims, both tables, what they mean, a section for each study, the
/// robot commands, and the protocol.
std::string summary_markdown(const RunResult& result, const PaperNumbers& paper);
/// A section of it: of each table title, explanation and rows.
std::string study_markdown(const StudyResult& study);
/// What the cells of the tables hold, in one paragraph of plain text.
std::string summary_explanation();

}  // namespace glovebench::reports
