#pragma once

#include <nlohmann/json.hpp>

#include "reports/commands.h"
#include "reports/json_reader.h"

namespace glovebench::reports {

/// "commands" of an experiment in results.json.
nlohmann::ordered_json commands_json(const CommandResult& commands);
/// Reads it back. Throws Error for whatever commands_json does not write.
CommandResult read_commands(const JsonReader& json);

}  // namespace glovebench::reports
