#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reports/results.h"
#include "reports/timings.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

struct ProgramInfo {
  std::string version;
  std::string commit;  ///< "unknown" outside a checkout; "-dirty" if changed
};
const ProgramInfo& program_info();

/// Without times.
reports::Timings host_timings(int threads);

/// GLOVEBENCH_SHARE, else ../share/glovebench beside the program.
/// Throws: Error.
std::string share_folder();
std::string hand_mesh_path();
std::string trajectory_folder();
std::string suite_folder();
/// Chart scripts in running order, with licenses.
/// Throws: Error.
std::vector<std::string> page_scripts();
/// GLOVEBENCH_CACHE, XDG_CACHE_HOME/glovebench or ~/.cache/glovebench.
std::string default_cache_folder();

/// Built-in ("Tr4"), generated ("side_3") or a file (*.json). `truth`: the kind to select or require.
/// Throws: Error, also for another kind.
trajectories::Trajectory load_truth(const std::string& name_or_file, std::optional<reports::TruthKind> truth);
/// Null for a user's file.
/// Throws: Error.
std::shared_ptr<const trajectories::Trajectory> find_truth(const reports::ExperimentKey& key);

}  // namespace glovebench::eval
