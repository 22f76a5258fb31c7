#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/experiment.h"
#include "eval/studies/study.h"
#include "reports/claims/verdicts.h"

namespace glovebench::eval {

struct ReproductionOptions {
  StudyOptions study;
  std::vector<std::string> trajectories;  ///< of Figure 4; empty: all five
  std::vector<reports::NoiseSetting> noises = {{}};
  std::vector<std::string> only;  ///< of part_names; empty: all, or with `trajectories` Figure 4
};

/// Hash of a study's inputs except the program, as `run_key`.
std::string study_key(Workbench& workbench, std::string_view name, const StudyOptions& options);

/// "fig4", "fig5", "fig6" and the studies.
std::vector<std::string> part_names();

/// 1 if a required claim failed; 3 if one was not measured although `judged` and all of Figure 4 was requested;
/// else 0.
int exit_code_of(const reports::RequiredClaims& required, const ReproductionOptions& options, bool judged);

/// Experiments of Figures 4 to 6.
/// Throws: Error.
Plan plan_reproduction(const ReproductionOptions& options);

/// Parts, estimated times, existing databases. Builds nothing.
std::string describe_reproduction(Workbench& workbench, const ReproductionOptions& options);

using ShowResults = std::function<void(const reports::RunResult& so_far)>;
/// Calls `show` after Figures 4 to 6 and each study.
/// Throws: Error as `plan_reproduction` and `carry_out`.
Outcome reproduce(
    Workbench& workbench, const ReproductionOptions& options, const RobotOutput& robot, const std::string& folder,
    const ShowResults& show = [](const reports::RunResult&) {});

}  // namespace glovebench::eval
