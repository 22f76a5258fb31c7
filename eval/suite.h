#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eval/plan.h"

namespace glovebench::eval {

/// A trajectory with the databases that it is tracked against.
struct SuiteEntry {
  std::string trajectory;                   ///< a name, or a file (*.json)
  std::optional<reports::TruthKind> truth;  ///< which of a named one; of a file what it must be, empty: either
  std::vector<std::string> databases;       ///< names, or files
  int subject = 1;
  reports::NoiseSetting noise;
  FrameRange frames;
};

/// Experiments that belong together: what a commit, or a night, is measured by. Seeds are the same for all entries.
struct Suite {
  std::string name;  ///< empty: of a command line
  std::string description;
  std::vector<uint64_t> seeds;
  std::vector<SuiteEntry> entries;
};

/// Reads the JSON format of trajectories/README.md strictly; relative files are those of `path`'s folder. Throws
/// Error naming `path` and the field.
Suite parse_suite(std::string_view text, const std::string& path);
/// A suite of the program's data folder by name ("quick", "full"), or a file (*.json). Throws Error for an unknown
/// name (listing the known ones) and for a file that is none.
Suite load_suite(const std::string& name_or_file);
std::vector<std::string> suite_names();

/// The hand that the suite is about, which its workbench must be for. Throws Error if its first trajectory cannot
/// be read.
Side side_of(const Suite& suite);

/// The suite's experiments, without those whose name the filter does not match
/// (shell wildcards; empty: all). Runs of the same frames are neighbors, so that a frame is rendered once. Files of
/// databases become known to the workbench; nothing is built. Throws Error if an experiment is there twice, a
/// trajectory is of the other hand, or nothing is left.
Plan plan_suite(Workbench& workbench, const TrackerConfig& tracker, const Suite& suite, const std::string& filter);

}  // namespace glovebench::eval
