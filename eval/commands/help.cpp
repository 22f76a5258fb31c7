#include "eval/commands/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "core/base/text.h"
#include "eval/program.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

constexpr size_t kOptionColumn = 32;  ///< where the helps of options begin
constexpr size_t kGap = 2;

/// Breaks lines that are too wide after commas, which have no spaces in lists of values.
std::string broken_at_commas(std::string text, size_t columns) {
  const std::string indent(2 * kGap, ' ');
  for (size_t begin = 0; text.size() - begin > columns;) {
    const size_t comma = text.rfind(',', begin + columns - 1);
    if (comma == std::string::npos || comma <= begin + indent.size()) break;
    text.insert(comma + 1, "\n" + indent);
    begin = comma + 2;
  }
  return text;
}

/// `left`, and `right` beside it from `column` on; below it if `left` is too wide.
std::string entry(const std::string& left, const std::string& right, size_t column, size_t columns) {
  std::string text = broken_at_commas(std::string(kGap, ' ') + left, columns);
  if (right.empty()) return text + "\n";
  const size_t width = text.size() - (text.rfind('\n') + 1);  // without a line end: all
  if (width + kGap > column)
    text.append("\n").append(column, ' ');
  else
    text.append(column - width, ' ');
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

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string one_line(const std::string& text) { return replaced(text, "\n", " "); }

/// Text in backticks becomes bold.
std::string roff(const std::string& text) {
  std::string line = replaced(replaced(one_line(text), "\\", "\\e"), "-", "\\-");
  for (bool begins = true; line.find('`') != std::string::npos; begins = !begins)
    line.replace(line.find('`'), 1, begins ? "\\fB" : "\\fR");
  return line.starts_with(".") || line.starts_with("'") ? "\\&" + line : line;
}

/// Lets lines break after commas, which have no spaces in lists of values.
std::string breakable(const std::string& text) { return replaced(text, ",", ",\\:"); }

std::string roff_option(const OptionText& option) {
  return fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", roff(fmt::format("{}", fmt::join(option.names, ", "))),
                     breakable(roff(option.value)), breakable(roff(option.help)));
}

/// All commands under `command` that have no commands under them. `name` includes the parents.
std::string roff_commands(const CommandText& command, const std::string& name) {
  std::string page;
  for (const CommandText& subcommand : command.subcommands) {
    const std::string full_name = name + " " + subcommand.name;
    if (subcommand.subcommands.empty()) {
      page += fmt::format(".SS {}\n{}\n", roff(full_name), roff(subcommand.description));
      for (const OptionText& option : subcommand.options)
        if (!option.names.back().starts_with("--help")) page += roff_option(option);
    }
    page += roff_commands(subcommand, full_name);
  }
  return page;
}

constexpr std::string_view kBash = R"sh(# For bash: source <(glovebench completion bash)
_glovebench() {
  local found
  found="$("${COMP_WORDS[0]}" completion words -- "${COMP_WORDS[@]:1:COMP_CWORD-1}" 2>/dev/null | cut -f 1)"
  mapfile -t COMPREPLY < <(compgen -W "$found" -- "${COMP_WORDS[COMP_CWORD]}")
}
complete -o default -F _glovebench glovebench
)sh";

constexpr std::string_view kZsh = R"sh(#compdef glovebench
# For zsh: source <(glovebench completion zsh)
_glovebench() {
  local -a found
  found=(${(f)"$("${words[1]}" completion words -- "${(@)words[2,CURRENT-1]}" 2>/dev/null)"})
  found=(${found//:/\\:})
  found=(${found/$'\t'/:})
  if (( $#found )); then _describe glovebench found; else _files; fi
}
if [[ "$funcstack[1]" == _glovebench ]]; then _glovebench "$@"; else compdef _glovebench glovebench; fi
)sh";

constexpr std::string_view kFish = R"sh(# For fish: glovebench completion fish | source
function __glovebench_words
  set -l found (glovebench completion words -- (commandline -opc)[2..] 2>/dev/null)
  if test -n "$found"
    printf '%s\n' $found
  else
    __fish_complete_path (commandline -ct)
  end
end
complete -c glovebench -f -a '(__glovebench_words)'
)sh";

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

std::string man_page(const CommandText& program, const std::string& version) {
  std::string page = fmt::format(
      ".TH GLOVEBENCH 1 \"\" \"glovebench {}\" \"User commands\"\n.ad l\n"
      ".SH NAME\nglovebench \\- evaluate and benchmark color\\-glove hand tracking\n"
      ".SH SYNOPSIS\n.B glovebench\n.I COMMAND\n[\\fIOPTION\\fR ...]\n.SH DESCRIPTION\n{}\n",
      roff(version), roff(program.description));
  for (const OptionText& option : program.options) page += roff_option(option);
  page += ".SH COMMANDS\n" + roff_commands(program, program.name);
  page +=
      ".SH ENVIRONMENT\n"
      ".TP\n.B GLOVEBENCH_CACHE\nFolder for databases and color tables "
      "[\\fBXDG_CACHE_HOME\\fR/glovebench or ~/.cache/glovebench].\n"
      ".TP\n.B GLOVEBENCH_SHARE\nFolder of the program's data [../share/glovebench beside the program].\n";
  return page;
}

std::string completions(const CommandText& program, const std::vector<std::string>& line) {
  const CommandText* command = &program;
  const OptionText* before = nullptr;  // the option that the last word of the line is
  for (const std::string& word : line) {
    const auto subcommand = std::ranges::find(command->subcommands, word, &CommandText::name);
    if (subcommand != command->subcommands.end()) command = &*subcommand;
    const auto option = std::ranges::find_if(
        command->options, [&](const OptionText& o) { return std::ranges::count(o.names, word) > 0; });
    before = option == command->options.end() || option->is_argument() ? nullptr : &*option;
  }
  std::string text;
  const auto add = [&](const std::string& word, const std::string& help) {
    text += word + "\t" + one_line(help) + "\n";
  };
  if (before != nullptr && before->takes_value) {
    for (const std::string& word : before->words) add(word, "");
    return text;
  }
  for (const CommandText& subcommand : command->subcommands) add(subcommand.name, subcommand.description);
  for (const OptionText& option : command->options)
    for (const std::string& word : option.is_argument() ? option.words : option.names) add(word, option.help);
  return text;
}

std::string completion_script(std::string_view shell) {
  return std::string(shell == "bash" ? kBash : shell == "zsh" ? kZsh : kFish);
}

void add_completion(Command program) {
  struct State {
    std::string what;
    std::vector<std::string> line;
  };
  const auto state = std::make_shared<State>();
  const Command command = program.subcommand(
      "completion", "Print a script with which a shell completes commands, options and their words.");
  command.option("shell", state->what, "the shell; words: what may follow the words after --")
      .one_of({"bash", "zsh", "fish", "words"})
      .required();
  command.option("line", state->line, "the words of a command line after the program's name");
  command.runs([state, program] {
    fmt::print("{}",
               state->what == "words" ? completions(program.text(), state->line) : completion_script(state->what));
  });
}

void add_manual(Command program) {
  program.subcommand("manual", "Print the manual page, for `man -l -`.").runs([program] {
    fmt::print("{}", man_page(program.text(), program_info().version));
  });
}

}  // namespace glovebench::eval
