#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/robot/command_guard.h"

namespace glovebench {

/// The limits with the fields of a JSON object in place of the defaults; keys carry their units. `where` names the
/// object in errors. Throws Error for unknown keys, wrong kinds, and limits with problems.
CommandLimits command_limits_from_json(const nlohmann::json& json, const std::string& where);
/// All fields but the coupling, which is a flag of its own; command_limits_from_json reads them back.
nlohmann::json to_json(const CommandLimits& limits);

}  // namespace glovebench
