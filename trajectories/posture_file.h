#pragma once

#include <set>
#include <string>
#include <string_view>

#include "core/base/json_cursor.h"
#include "core/database/database.h"
#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// The text as a JSON string, quoted and escaped.
std::string in_quotes(std::string_view text);
/// The 22 names of angle_infos(), in order, as a JSON array on lines indented by two spaces.
std::string joint_order_json();
/// The field must be the array of the 22 names in the order of angle_infos().
void expect_joint_order(const JsonCursor& field);

/// 22 angles in degrees, to 0.001, as a JSON array.
std::string angles_json(const Posture& posture);
/// 22 angles in degrees, each within its limits.
Posture angles_from(const JsonCursor& field);

/// Adds the name of a posture to those of its set. Throws Error if it was there before.
void expect_new_name(const std::string& name, std::set<std::string>& names, const std::string& where,
                     const std::string& field);
/// Posture sets in the formats of README.md: JSON ("glovebench-postures"), or CSV with the headings `name` and the
/// 22 names of angle_infos(), degrees. `where` names the text in messages. All throw Error naming the field, what
/// was found and what was expected: postures with equal names, wrong headings, angles beyond their limits, ...
PostureSet parse_postures_json(std::string_view text, const std::string& where);
/// A CSV names no set: `set_name` does.
PostureSet parse_postures_csv(std::string_view text, const std::string& set_name, const std::string& where);

/// The canonical file content, angles to 0.001 deg; byte for byte the same for the set parsed from it. Throws Error
/// if the set would be refused when it is read.
std::string canonical_text(const PostureSet& set);
void write_posture_set(const PostureSet& set, const std::string& path);

/// The posture of that name. Throws Error naming the set and what it holds.
const Posture& find_posture(const PostureSet& set, std::string_view name);

}  // namespace glovebench::trajectories
