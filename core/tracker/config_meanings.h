#pragma once

#include <span>
#include <string_view>

#include "core/tracker/tracker_config.h"

namespace glovebench {

std::span<const ConfigMeaning> config_meanings();
/// Throws: std::logic_error for an unknown field.
const ConfigMeaning& config_meaning(std::string_view field);

}  // namespace glovebench
