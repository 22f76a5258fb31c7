#pragma once

#include <string>
#include <vector>

#include "reports/tables.h"

namespace glovebench::reports {

/// A table of texts, for Markdown and HTML. The first `name_columns` columns are names, the others numbers.
struct TextTable {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
  int name_columns = 2;
};
std::string to_markdown(const TextTable& table);
std::string to_html(const TextTable& table);

/// What names an experiment in a table: trajectory, database, truth and noise.
std::vector<std::string> experiment_heading();
std::vector<std::string> experiment_cells(const ExperimentKey& key);

/// Figure 4: a column for each variant and one for the paper's printed means.
TextTable figure4_summary(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// One row an experiment, of any noise: the mean position error with its interval, the metrics that depend on no
/// joint convention, jitter, latency, lost and false frames.
TextTable detail_summary(const RunResult& result);

/// What to know of a quick run before its numbers, as plain text; empty for any other.
std::string quick_note(const RunResult& result);

/// summary.md: what became of the paper's claims, both tables, what they mean, a section for each study, the
/// robot commands, and the protocol.
std::string summary_markdown(const RunResult& result, const PaperNumbers& paper);
/// What the cells of the tables hold, in one paragraph of plain text.
std::string summary_explanation();

}  // namespace glovebench::reports
