#pragma once

#include <map>
#include <string>

namespace glovebench::trajectories {

/// Makes every generated file, by path in the data folder, from its gestures and scripts.
/// Throws: Error.
std::map<std::string, std::string> generate_data_files(const std::string& data_folder);

/// Lists properties of the source trajectories as a Markdown table: distances, speeds, grasps.
/// Throws: Error.
std::string source_properties_table(const std::string& data_folder);

}  // namespace glovebench::trajectories
