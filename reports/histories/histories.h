#pragma once

#include <string>

#include "reports/results.h"

namespace glovebench::reports {

// A run in the formats of the services that keep a benchmark's history from commit to commit.

/// Bencher Metric Format: benchmark = experiment, measure = quantity (comparison/quantities.h), with the run's
/// bootstrap interval as lower_value and upper_value.
std::string bencher_json(const RunResult& result);
/// github-action-benchmark's customSmallerIsBetter: an entry for each experiment and quantity.
std::string github_action_benchmark_json(const RunResult& result);

}  // namespace glovebench::reports
