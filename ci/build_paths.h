#pragma once

#include <string>

/// Paths of this build, for tests and benchmarks only (compiler caches).
namespace glovebench::build_paths {

std::string source(const std::string& path);   ///< of the repository
std::string program(const std::string& name);  ///< of this build
std::string share(const std::string& path);    ///< of the installed data
std::string hand_mesh();
std::string fakenect();            ///< folder of a libfreenect that plays recordings
std::string unplugged_freenect();  ///< folder of a libfreenect that fails

}  // namespace glovebench::build_paths
