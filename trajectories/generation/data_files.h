#pragma once

#include <map>
#include <string>

namespace glovebench::trajectories {

/// The content of every generated file, by its path under the data folder ("sources/Tr1.json"), made from the
/// gestures and scripts that lie there. Throws Error if those are missing or wrong.
std::map<std::string, std::string> generate_data_files(const std::string& data_folder);

/// Properties of the source trajectories in the data folder, a line of Markdown each: distances, speeds, grasps.
/// Throws Error.
std::string source_properties_table(const std::string& data_folder);

}  // namespace glovebench::trajectories
