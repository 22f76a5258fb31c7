#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/database/database.h"

namespace glovebench::trajectories {

inline constexpr size_t kPostureCount20 = 20;

/// Random blends of two or three gestures within limits, wrist at 0.
std::vector<Posture> movement_posture_pool(const PostureSet& gestures);

/// The sets of section IV.
std::vector<PostureSet> make_database_posture_sets(const PostureSet& gestures);

/// Files by path in the data folder, made from its gestures and scripts.
/// Throws: Error.
std::map<std::string, std::string> generate_data_files(const std::string& data_folder);

/// Markdown.
/// Throws: Error.
std::string source_properties_table(const std::string& data_folder);

}  // namespace glovebench::trajectories
