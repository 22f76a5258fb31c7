#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eval/commands/options.h"

namespace glovebench::eval {

/// The program's page of the manual, for man(1): every command with its options.
std::string man_page(const CommandText& program, const std::string& version);

/// What may follow `line`, the words after the program's name: lines `WORD<tab>DESCRIPTION`. Empty where the
/// program knows no words, as after `--output`: the shell completes file names there.
std::string completions(const CommandText& program, const std::vector<std::string>& line);

/// A script for bash, zsh or fish, which asks the program for `completions`.
std::string completion_script(std::string_view shell);

}  // namespace glovebench::eval
