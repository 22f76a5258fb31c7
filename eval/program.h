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
/// Throws: Error if there is none.
std::string share_folder();
std::string hand_mesh_path();
std::string trajectory_folder();
std::string suite_folder();
/// Chart scripts in running order, with licenses.
/// Throws: Error if one is missing.
std::vector<std::string> page_scripts();
/// GLOVEBENCH_CACHE, XDG_CACHE_HOME/glovebench or ~/.cache/glovebench.
std::string default_cache_folder();

/// Built-in ("Tr4"), generated ("side_3") or a file (*.json). `truth`: the kind to select, or that the file must
/// have.
/// Throws: Error for an unknown name, another kind or a bad file.
trajectories::Trajectory load_truth(const std::string& name_or_file, std::optional<reports::TruthKind> truth);
/// An experiment's built-in truth. Null for a user's file.
/// Throws: Error if the data folder is damaged.
std::shared_ptr<const trajectories::Trajectory> find_truth(const reports::ExperimentKey& key);

}  // namespace glovebench::eval
