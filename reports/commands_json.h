#pragma once

#include <nlohmann/json.hpp>

#include "core/base/json_cursor.h"
#include "reports/commands.h"

namespace glovebench::reports {

/// "commands" of an experiment in results.json.
nlohmann::ordered_json commands_json(const CommandResult& commands);
/// Reads it back. Throws Error for whatever commands_json does not write.
CommandResult read_commands(const JsonCursor& json);

}  // namespace glovebench::reports
