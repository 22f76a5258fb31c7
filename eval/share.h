#pragma once

#include <string>
#include <vector>

namespace glovebench::eval {

/// GLOVEBENCH_SHARE, else ../share/glovebench beside the program.
/// Throws: Error if there is none.
std::string share_folder();
std::string hand_mesh_path();
std::string trajectory_folder();
std::string suite_folder();
/// Chart scripts in running order, each after its license.
/// Throws: Error if one is missing.
std::vector<std::string> page_scripts();
/// GLOVEBENCH_CACHE, XDG_CACHE_HOME/glovebench or ~/.cache/glovebench.
std::string default_cache_folder();

}  // namespace glovebench::eval
