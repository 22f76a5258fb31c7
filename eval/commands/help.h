#pragma once

#include <string>

#include "eval/commands/options.h"

namespace glovebench::eval {

/// What --help prints: description, `usage`, arguments, options by group, commands. Rare options only if `all`.
std::string help_text(const CommandText& command, const std::string& usage, bool all, size_t columns);

/// The commands under `command`, each with the first line of its description.
std::string commands_text(const CommandText& command, size_t columns);

/// "unknown flag --ouptut; did you mean --output?", for a word after `command` that is none of its own.
std::string describe_unknown(const CommandText& command, const std::string& word);

}  // namespace glovebench::eval
