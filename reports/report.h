#pragma once

#include <string>
#include <vector>

#include "reports/estimates.h"
#include "reports/page/page.h"
#include "reports/results.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// Writes a run's folder and returns the names of its files:
///   results.json   everything (reports/schema/results.schema.json)
///   config.json    the effective configuration
///   summary.md     the tables, to read
///   index.html     tables, charts, pictures; one file that needs no other
///   timings.json   what differs from run to run
///   claims.json    what became of the paper's claims, if any was run; tables/claims.csv the same as a table
///   tables/        figure4.csv and .tex; figure5.csv and figure6.csv if those experiments were run; frames_*.csv
///                  for each; commands.csv; one file a table of a study
///   histories/     bencher.json and github_action_benchmark.json, for services that keep a history
///   estimates/     what the tracker said, one file an experiment
/// Without studies all but timings.json and the latencies in index.html depend on the results alone; with them, so
/// does results.json, but their tables and what the claims say hold times as well.
/// The files are one set (core/base/file_set.h): a reader gets the older report or the new one. Files of an older
/// report that manifest.json names and the new one lacks go. Throws Error if the folder cannot be written; an older
/// report then stays as it was.
std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const PageMaterial& material = {},
                                      const std::vector<ExperimentEstimates>& estimates = {});

}  // namespace glovebench::reports
