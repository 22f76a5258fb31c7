#pragma once

#include <string>
#include <string_view>

#include "core/database/database.h"

namespace glovebench::trajectories {

/// Posture sets in the formats of README.md: JSON ("glovebench-postures"), or CSV with the headings `name` and the
/// 22 names of angle_infos(), degrees. `where` names the text in messages. All throw Error naming the field, what
/// was found and what was expected: postures with equal names, wrong headings, angles beyond their limits, ...
PostureSet parse_postures_json(std::string_view text, const std::string& where);
/// A CSV names no set: `set_name` does.
PostureSet parse_postures_csv(std::string_view text, const std::string& set_name, const std::string& where);

/// Loads "*.json" or "*.csv"; a set from CSV is named after its file.
PostureSet load_posture_set(const std::string& path);

/// The canonical file content, angles to 0.001 deg; byte for byte the same for the set parsed from it. Throws Error
/// if the set would be refused when it is read.
std::string canonical_text(const PostureSet& set);
void write_posture_set(const PostureSet& set, const std::string& path);

/// The posture of that name. Throws Error naming the set and what it holds.
const Posture& find_posture(const PostureSet& set, std::string_view name);

}  // namespace glovebench::trajectories
