#pragma once

#include <chrono>
#include <span>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"
#include "reports/estimates.h"
#include "reports/timings.h"

namespace glovebench::eval {

/// One run per seed.
struct Experiment {
  reports::ExperimentKey key;
  std::vector<const MeasuredRun*> runs;
};
/// In order of first appearance. `runs` must outlive the result; each seed occurs once.
std::vector<Experiment> experiments_of(std::span<const MeasuredRun> runs);

/// Errors, protocol, input hashes and configuration; no robot commands, no studies.
reports::RunResult results_of(const Plan& plan, std::span<const MeasuredRun> runs, Workbench& workbench);
/// Stage times on this host.
reports::Timings timings_of(std::span<const MeasuredRun> runs, int threads);
std::vector<reports::ExperimentEstimates> estimates_of(std::span<const MeasuredRun> runs);
/// Adds the wall time since `start` and the peak memory.
void note_resources(reports::Timings& timings, std::chrono::steady_clock::time_point start);

}  // namespace glovebench::eval
