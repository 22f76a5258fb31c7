#pragma once

#include <string>

/// Where this build and its sources are, for tests and benchmarks. Their definitions are the only object with a
/// path of this machine in it (ci/build_paths.cpp.in): a compiler cache finds all others for a clone at any place.
namespace glovebench::build_paths {

std::string source(const std::string& path);   ///< a file or folder of the repository
std::string program(const std::string& name);  ///< an executable of this build
std::string share(const std::string& path);    ///< a file or folder of the data beside the programs
std::string hand_mesh();
std::string fakenect();            ///< the folder of libfreenect's stand-in that plays recordings
std::string unplugged_freenect();  ///< the folder of libfreenect's stand-in that fails

}  // namespace glovebench::build_paths
