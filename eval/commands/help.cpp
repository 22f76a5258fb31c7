#include "eval/commands/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/text.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

constexpr size_t kOptionColumn = 32;  ///< where the helps of options begin
constexpr size_t kGap = 2;

/// `left`, and `right` beside it from `column` on; below it if `left` is too wide.
std::string entry(const std::string& left, const std::string& right, size_t column, size_t columns) {
  std::string text = std::string(kGap, ' ') + left;
  if (right.empty()) return text + "\n";
  if (text.size() + kGap > column)
    text.append("\n").append(column, ' ');
  else
    text.resize(column, ' ');
  return text + reports::wrapped(right, columns, column);
}

std::string option_entry(const OptionText& option, size_t columns) {
  const std::string names = fmt::format("{}", fmt::join(option.names, ","));
  return entry(option.value.empty() ? names : names + " " + option.value, option.help, kOptionColumn, columns);
}

std::vector<std::string> groups_of(const CommandText& command) {
  std::vector<std::string> groups;
  for (const OptionText& option : command.options)
    if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
  return groups;
}

std::string paragraphs(const std::string& text, size_t columns) {
  std::string lines;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    lines += reports::wrapped(text.substr(begin, end - begin), columns);
    begin = end + 1;
  }
  return lines;
}

}  // namespace

std::string help_text(const CommandText& command, const std::string& usage, bool all, size_t columns) {
  std::string text = paragraphs(command.description, columns) + usage;
  const auto add_section = [&](const std::string& heading, const auto& belongs) {
    std::string entries;
    for (const OptionText& option : command.options)
      if (belongs(option)) entries += option_entry(option, columns);
    if (!entries.empty()) text += fmt::format("\n{}:\n{}", heading, entries);
  };
  add_section("Arguments", [](const OptionText& option) { return option.is_argument(); });
  for (const std::string& group : groups_of(command))
    add_section(group, [&](const OptionText& option) {
      return !option.is_argument() && option.group == group && (all || !option.is_rare);
    });
  if (!command.subcommands.empty()) text += "\nCommands:\n" + commands_text(command, columns);
  return text;
}

std::string commands_text(const CommandText& command, size_t columns) {
  size_t longest = 0;
  for (const CommandText& subcommand : command.subcommands) longest = std::max(longest, subcommand.name.size());
  std::string text;
  for (const CommandText& subcommand : command.subcommands)
    text += entry(subcommand.name, subcommand.description.substr(0, subcommand.description.find('\n')),
                  longest + 2 * kGap, columns);
  return text;
}

std::string describe_unknown(const CommandText& command, const std::string& word) {
  const bool is_flag = word.starts_with("-");
  std::vector<std::string> known;
  for (const OptionText& option : command.options)
    if (is_flag && !option.is_argument()) known.insert(known.end(), option.names.begin(), option.names.end());
  for (const CommandText& subcommand : command.subcommands)
    if (!is_flag) known.push_back(subcommand.name);
  const std::string name = is_flag ? word.substr(0, word.find('=')) : word;
  const char* const kind = is_flag ? "unknown flag" : known.empty() ? "unexpected argument" : "unknown command";
  return fmt::format("{} {}{}", kind, printable(name), did_you_mean(name, known));
}

}  // namespace glovebench::eval
