#pragma once

#include <string>

namespace glovebench::eval {

/// The folder of the program's data files: ../share/glovebench beside the running program, or GLOVEBENCH_SHARE.
/// Throws Error if there is none.
std::string share_folder();
std::string hand_mesh_path();
/// The trajectories' data folder (trajectories/catalog.h).
std::string trajectory_folder();
std::string suite_folder();
/// Where databases and color tables are kept: GLOVEBENCH_CACHE, XDG_CACHE_HOME/glovebench or ~/.cache/glovebench.
std::string default_cache_folder();

}  // namespace glovebench::eval
