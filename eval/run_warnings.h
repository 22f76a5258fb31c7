#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"
#include "reports/results.h"

namespace glovebench::eval {

/// A sentence per trajectory and likely mistake of its units.
std::vector<std::string> unit_warnings(const Plan& plan);

/// A sentence per experiment that lost all frames, with a command that explains one if one can.
/// `folder`: the run's. Empty if the tracker is a program.
std::vector<std::string> lost_hand_warnings(const Plan& plan, const reports::RunResult& result,
                                            const std::string& folder);

/// A sentence per reason, the commonest first; after the fifth, one for the others.
std::vector<std::string> no_answer_warnings(const std::map<std::string, size_t>& reasons);
std::map<std::string, size_t> no_answer_reasons(std::span<const MeasuredRun> runs);

/// Names of truths (truth_name) and databases from files.
/// Throws: Error.
std::set<std::string> inputs_from_files(const Plan& plan);

}  // namespace glovebench::eval
