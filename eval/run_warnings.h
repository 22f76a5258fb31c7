#pragma once

#include <set>
#include <string>
#include <vector>

#include "eval/plan.h"
#include "reports/results.h"

namespace glovebench::eval {

/// A sentence per trajectory and likely mistake of its units.
std::vector<std::string> unit_warnings(const Plan& plan);

/// A sentence per experiment that lost all frames, with the command that shows one of them. `folder`: the run's.
std::vector<std::string> lost_hand_warnings(const Plan& plan, const reports::RunResult& result,
                                            const std::string& folder);

/// Truths (truth_name) and databases that were read from files; the program has none, or others, of these names.
/// Throws: Error if the data folder is damaged.
std::set<std::string> inputs_from_files(const Plan& plan);

}  // namespace glovebench::eval
