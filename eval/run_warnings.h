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

/// A sentence per experiment that lost all frames, with the command that shows one of them. `folder`: the run's.
/// Empty if the tracker is a program, whose stages nobody sees.
std::vector<std::string> lost_hand_warnings(const Plan& plan, const reports::RunResult& result,
                                            const std::string& folder);

/// A sentence per reason why a program gave no answer, the commonest first; after the fifth one for all others.
/// `reasons`: with their counts.
std::vector<std::string> no_answer_warnings(const std::map<std::string, size_t>& reasons);
std::map<std::string, size_t> no_answer_reasons(std::span<const MeasuredRun> runs);

/// Truths (truth_name) and databases that were read from files; the program has none, or others, of these names.
/// Throws: Error if the data folder is damaged.
std::set<std::string> inputs_from_files(const Plan& plan);

}  // namespace glovebench::eval
