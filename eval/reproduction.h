#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eval/plan.h"
#include "eval/robot_commands.h"
#include "eval/studies/study.h"
#include "reports/claims/verdicts.h"

namespace glovebench::eval {

/// What `glovebench reproduce` is asked for.
struct ReproductionOptions {
  StudyOptions study;
  std::vector<std::string> trajectories;             ///< of Figure 4; empty: all five
  std::vector<reports::NoiseSetting> noises = {{}};  ///< of Figure 4
  std::vector<std::string> only;                     ///< names of parts (part_names); empty: all
};

/// What can be left out: "fig4", "fig5", "fig6", and the studies.
std::vector<std::string> part_names();

/// 1 if a required claim failed; 3 if one was not measured in a run that judges claims (are_claims_judged) and was
/// asked for all of Figure 4, on which they rest; else 0: an inconclusive claim fails nothing.
int exit_code_of(const reports::RequiredClaims& required, const ReproductionOptions& options, bool judged);

/// The experiments of Figures 4 to 6 that are asked for.
Plan plan_reproduction(const ReproductionOptions& options);

struct Reproduction {
  reports::RunResult result;
  reports::Timings timings;
};
/// Takes the results so far.
using ShowResults = std::function<void(const reports::RunResult& so_far)>;
/// Runs the paper's experiments and studies and writes their report into a folder. What an interrupted run finished
/// is taken from the folder. `show` is called when Figures 4 to 6 are there, and after each study. Throws Error for
/// an unknown part.
Reproduction reproduce(
    Workbench& workbench, const ReproductionOptions& options, const RobotOutput& robot, const std::string& folder,
    const ShowResults& show = [](const reports::RunResult&) {});

}  // namespace glovebench::eval
