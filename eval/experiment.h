#pragma once

#include <chrono>
#include <span>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"
#include "reports/estimates.h"
#include "reports/timings.h"

namespace glovebench::eval {

/// The runs of one experiment: one a seed.
struct Experiment {
  reports::ExperimentKey key;
  std::vector<const MeasuredRun*> runs;
};
/// Runs by experiment, in the order of the first run of each. The runs must outlive it; no seed counts twice.
std::vector<Experiment> experiments_of(std::span<const MeasuredRun> runs);

/// What a plan's runs came to: the errors of each experiment, and all that they depend on. Robot commands and
/// studies are added by others.
reports::RunResult results_of(const Plan& plan, std::span<const MeasuredRun> runs, Workbench& workbench);
/// The times of each experiment's stages, on this host.
reports::Timings timings_of(std::span<const MeasuredRun> runs, int threads);
/// What the trackers said, by experiment.
std::vector<reports::ExperimentEstimates> estimates_of(std::span<const MeasuredRun> runs);
/// Adds the time since the start, and the peak memory of the process.
void note_resources(reports::Timings& timings, std::chrono::steady_clock::time_point start);

}  // namespace glovebench::eval
