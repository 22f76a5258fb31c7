#pragma once

#include <string>
#include <vector>

#include "eval/experiments.h"

namespace glovebench::eval {

/// A trajectory with the databases that it is tracked against.
struct SuiteEntry {
  std::string trajectory;                                 ///< a name, or a file (*.json) relative to the suite's
  reports::TruthKind truth = reports::TruthKind::source;  ///< which of a named one
  std::vector<std::string> databases;                     ///< names, or files relative to the suite's
  int subject = 1;
  reports::NoiseSetting noise;
  FrameRange frames;
};

/// Experiments that belong together: what a commit, or a night, is measured by. Seeds are the same for all entries.
struct Suite {
  std::string name;
  std::string description;
  std::vector<uint64_t> seeds;
  std::vector<SuiteEntry> entries;
};

/// A suite of the program's data folder by name ("quick", "full"), or a file (*.json). Throws Error for an unknown
/// name (listing the known ones) and for a file that is none.
Suite load_suite(const std::string& name_or_file);
std::vector<std::string> suite_names();

/// The suite's experiments, as a plan for run_experiments, without those whose name the filter does not match
/// (shell wildcards; empty: all). Files of databases become known to the workbench. Throws Error if nothing is
/// left.
Plan plan_suite(Workbench& workbench, const TrackerConfig& tracker, const Suite& suite, const std::string& filter);

}  // namespace glovebench::eval
