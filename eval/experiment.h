#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "eval/command_measurement.h"
#include "eval/measured_run.h"
#include "eval/plan.h"
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

struct Outcome {
  reports::RunResult result;
  reports::Timings timings;
};
/// Adds studies to the result of the experiments; `store` keeps what is finished.
using AddStudies = std::function<void(reports::RunResult& result, RunStore& store)>;
/// Executes and measures the plan's runs, adds robot commands and studies, and writes the report into `folder`.
/// Resumes an interrupted run.
/// Throws: Error for a wrong plan, before any work, or a folder that cannot be written.
Outcome carry_out(
    Workbench& workbench, const Plan& plan, const RobotOutput& robot, const std::string& folder,
    const AddStudies& add_studies = [](reports::RunResult&, RunStore&) {});

}  // namespace glovebench::eval
