#pragma once

#include <string>
#include <vector>

#include "reports/estimates.h"
#include "reports/page/page.h"
#include "reports/results.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// Writes a run's files (reports/README.md) as one set (core/base/file_set.h). Returns their names.
/// Throws: Error if the folder cannot be written; an older report then stays.
std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const PageMaterial& material = {},
                                      const std::vector<ExperimentEstimates>& estimates = {});

/// Bencher Metric Format: a benchmark per experiment, a measure with interval per gated metric.
std::string bencher_json(const RunResult& result);
/// customSmallerIsBetter: one entry per experiment and gated metric.
std::string github_action_benchmark_json(const RunResult& result);

}  // namespace glovebench::reports
