#pragma once

#include <string>

#include "reports/results.h"

namespace glovebench::reports {

// A run in the formats of the services that keep a benchmark's history from commit to commit.

/// Bencher Metric Format: benchmark = experiment, measure = gated metric, with the run's
/// bootstrap interval as lower_value and upper_value.
std::string bencher_json(const RunResult& result);
/// github-action-benchmark's customSmallerIsBetter: an entry for each experiment and gated metric.
std::string github_action_benchmark_json(const RunResult& result);

}  // namespace glovebench::reports
