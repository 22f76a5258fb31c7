#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eval/plan.h"

namespace glovebench::eval {

struct SuiteEntry {
  std::string trajectory;  ///< name (also of a generated movement) or *.json file
  std::optional<reports::TruthKind>
      truth;                           ///< kind of a named trajectory, or required kind of a file; empty: either
  std::vector<std::string> databases;  ///< names or files
  int subject = 1;
  Appearance appearance = Appearance::glove;  ///< of the command line alone
  reports::NoiseSetting noise;
  FrameRange frames;
};

/// Experiments with the same seeds.
struct Suite {
  std::string name;  ///< empty: command line
  std::string description;
  std::vector<uint64_t> seeds;
  std::vector<SuiteEntry> entries;
};

/// Reads the format of trajectories/README.md. Files are relative to the folder of `path`.
/// Throws: Error.
Suite parse_suite(std::string_view text, const std::string& path);
/// "quick", "full" or a *.json file.
/// Throws: Error.
Suite load_suite(const std::string& name_or_file);
std::vector<std::string> suite_names();

/// Side of the first trajectory. The workbench must have the same.
/// Throws: Error.
Side side_of(const Suite& suite);

/// Experiments that match `filter` (shell wildcards; empty: all). Those of the same frames are successive. Adds
/// database files to the workbench. Builds nothing.
/// Throws: Error for a repeated experiment, the other hand, or no match.
Plan plan_suite(Workbench& workbench, const TrackerConfig& tracker, const Suite& suite, const std::string& filter);

}  // namespace glovebench::eval
