#pragma once

#include <chrono>
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
/// In order of appearance. `runs` must outlive the result. A seed occurs once.
std::vector<Experiment> experiments_of(std::span<const MeasuredRun> runs);
/// Means, coverage and curves over frames and seeds.
reports::ExperimentResult evaluate(const Experiment& experiment);
/// True if each answer has posture and pose.
bool has_hands(const Experiment& experiment);

/// Results without robot commands and studies.
reports::RunResult results_of(const Plan& plan, std::span<const MeasuredRun> runs, Workbench& workbench);

struct Outcome {
  reports::RunResult result;
  reports::Timings timings;
};
struct TimedWith {
  int threads = 1;
  std::chrono::steady_clock::time_point start;
  bool commands = true;  ///< false: omit times of commands, measured with other `threads`
};
/// Reports measured runs, with robot commands, families and `add_studies`.
/// Throws: Error.
Outcome report_runs(
    Workbench& workbench, const Plan& plan, std::span<const MeasuredRun> runs, const TimedWith& timed,
    const RobotOutput& robot, const std::string& folder,
    const std::function<void(reports::RunResult&)>& add_studies = [](reports::RunResult&) {});

using AddStudies = std::function<void(reports::RunResult& result, RunStore& store)>;
/// Executes, measures and reports the plan's runs. Resumes an interrupted run.
/// Throws: Error before any work for a wrong plan, or as `report_runs`.
Outcome carry_out(
    Workbench& workbench, const Plan& plan, const RobotOutput& robot, const std::string& folder,
    const AddStudies& add_studies = [](reports::RunResult&, RunStore&) {});

}  // namespace glovebench::eval
