#pragma once

#include <string>
#include <vector>

namespace glovebench::eval {

/// The folder of the program's data files: ../share/glovebench beside the running program, or GLOVEBENCH_SHARE.
/// Throws Error if there is none.
std::string share_folder();
std::string hand_mesh_path();
/// The trajectories' data folder (trajectories/catalog.h).
std::string trajectory_folder();
std::string suite_folder();
/// The scripts that draw the charts of a report's page, each with its license in a comment before it, in the order
/// in which they are to run. Throws Error if one is missing.
std::vector<std::string> page_scripts();
/// Where databases and color tables are kept: GLOVEBENCH_CACHE, XDG_CACHE_HOME/glovebench or ~/.cache/glovebench.
std::string default_cache_folder();

}  // namespace glovebench::eval
