#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eval/commands/options.h"

namespace glovebench::eval {

/// Rare options only if `all`.
std::string help_text(const CommandText& command, const std::string& usage, bool all, size_t columns);

/// The subcommands, with the first lines of their descriptions.
std::string commands_text(const CommandText& command, size_t columns);

/// "unknown flag --ouptut; did you mean --output?"
std::string describe_unknown(const CommandText& command, const std::string& word);

std::string man_page(const CommandText& program, const std::string& version);

/// Lines `WORD<tab>DESCRIPTION` for the word after `line`. Empty for file names, which the shell completes.
std::string completions(const CommandText& program, const std::vector<std::string>& line);

/// For bash, zsh or fish. Calls `completions`.
std::string completion_script(std::string_view shell);

}  // namespace glovebench::eval
