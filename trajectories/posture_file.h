#pragma once

#include <set>
#include <string>
#include <string_view>

#include "core/base/json_cursor.h"
#include "core/database/database.h"
#include "core/hand/posture.h"

namespace glovebench::trajectories {

std::string in_quotes(std::string_view text);
std::string joint_order_json();
/// Throws: Error unless `field` has the names of angle_infos().
void expect_joint_order(const JsonCursor& field);

/// 22 angles in degrees, to 0.001.
std::string angles_json(const Posture& posture);
/// 22 angles in degrees.
/// Throws: Error outside of limits.
Posture angles_from(const JsonCursor& field);

/// Throws: Error if the name is in `names`.
void expect_new_name(const std::string& name, std::set<std::string>& names, const std::string& where,
                     const std::string& field);
/// Parse JSON "glovebench-postures" or a CSV (README.md).
/// Throws: Error.
PostureSet parse_postures_json(std::string_view text, const std::string& where);
PostureSet parse_postures_csv(std::string_view text, const std::string& set_name, const std::string& where);

/// Parsing reproduces it byte for byte.
/// Throws: Error if it could not be read again.
std::string canonical_text(const PostureSet& set);
void write_posture_set(const PostureSet& set, const std::string& path);

/// Throws: Error for an unknown name.
const Posture& find_posture(const PostureSet& set, std::string_view name);

}  // namespace glovebench::trajectories
