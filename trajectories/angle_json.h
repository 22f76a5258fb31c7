#pragma once

#include <string>
#include <string_view>

#include "core/base/json_cursor.h"
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

}  // namespace glovebench::trajectories
