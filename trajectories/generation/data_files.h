#pragma once

#include <map>
#include <string>

namespace glovebench::trajectories {

/// Makes every generated file from gestures and scripts, by path in the data folder.
/// Throws: Error.
std::map<std::string, std::string> generate_data_files(const std::string& data_folder);

/// Markdown: distances, speeds, grasps of the source trajectories.
/// Throws: Error.
std::string source_properties_table(const std::string& data_folder);

}  // namespace glovebench::trajectories
