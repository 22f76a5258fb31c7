#pragma once

#include <string>

#include "reports/results.h"

namespace glovebench::reports {

// A run for services with benchmark histories.

/// Bencher Metric Format: benchmark = experiment, measure = gated metric, lower_value and upper_value = bootstrap
/// interval.
std::string bencher_json(const RunResult& result);
/// github-action-benchmark's customSmallerIsBetter: an entry for each experiment and gated metric.
std::string github_action_benchmark_json(const RunResult& result);

}  // namespace glovebench::reports
