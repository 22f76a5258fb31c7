#pragma once

#include <string>

#include "eval/experiments.h"

namespace glovebench::eval {

/// The experiments of a plan, one a line: name, frames x seeds.
std::string list_experiments(const Plan& plan);

/// What running the plan comes to: its experiments, seeds and frames, and which databases are there already. Builds
/// nothing.
std::string describe_plan(Workbench& workbench, const Plan& plan);

}  // namespace glovebench::eval
