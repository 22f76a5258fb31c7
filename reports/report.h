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
///   config.json    effective configuration
///   summary.md     the tables
///   index.html     tables, charts, pictures in one file
///   timings.json   what differs from run to run
///   claims.json    verdicts on the paper's claims, if any was run
///   tables/        CSV and LaTeX of figures, frames, commands, claims, studies
///   histories/     for services that keep a history
///   estimates/     one file per experiment
/// Only timings.json, the page's latencies, studies' tables and claims depend on more than the results.
/// The files are one set (core/base/file_set.h) that replaces an older report's as a whole.
/// Throws: Error if the folder cannot be written; an older report then stays.
std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const PageMaterial& material = {},
                                      const std::vector<ExperimentEstimates>& estimates = {});

// A run for services that keep benchmark histories.

/// Bencher Metric Format: benchmark = experiment, measure = gated metric, lower_value and upper_value = bootstrap
/// interval.
std::string bencher_json(const RunResult& result);
/// github-action-benchmark's customSmallerIsBetter: one entry per experiment and gated metric.
std::string github_action_benchmark_json(const RunResult& result);

}  // namespace glovebench::reports
