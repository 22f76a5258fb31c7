#pragma once

#include <string>

#include "eval/plan.h"

namespace glovebench::eval {

/// Writes FOLDER/EXPERIMENT.mcap of each experiment's first seed: rendered frames, truth, and estimates of
/// FOLDER/estimates/.
/// Throws: Error.
void write_run_mcaps(Workbench& workbench, const Plan& plan, const std::string& folder);

}  // namespace glovebench::eval
