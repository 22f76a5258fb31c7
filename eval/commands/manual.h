#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eval/commands/options.h"

namespace glovebench::eval {

std::string man_page(const CommandText& program, const std::string& version);

/// Lines `WORD<tab>DESCRIPTION` for the word after `line`. Empty: the shell completes file names.
std::string completions(const CommandText& program, const std::vector<std::string>& line);

/// The script for bash, zsh or fish; calls `completions`.
std::string completion_script(std::string_view shell);

}  // namespace glovebench::eval
