#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace glovebench::eval {

/// Restricts an option. Each call returns the same option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required() const;
  Option in(double low, double high) const;
  Option not_negative() const;
  Option one_of(const std::vector<std::string>& words) const;
  /// Rejects `-`.
  Option named_file() const;
  Option existing_file() const;
  Option existing_folder() const;
  Option count(int values) const;
  /// A list: one option per value.
  Option repeated() const;
  /// A list: commas may separate values.
  Option comma_separated() const;
  /// `other` must exist.
  Option needs(const std::string& other) const;
  /// Only --help-all shows it.
  Option rare() const;

 private:
  CLI::Option* option_;
};

struct OptionText {
  std::vector<std::string> names;  ///< `-o`, `--output`; an argument has no dashes
  bool takes_value = true;
  std::string value;  ///< for the help: type, range, default, needs
  std::string help;
  std::vector<std::string> words;  ///< allowed values; empty: any
  std::string group = "Options";   ///< heading in the help
  bool is_rare = false;

  bool is_argument() const { return !names.front().starts_with("-"); }
};

struct CommandText {
  std::string name;
  std::string description;
  std::vector<OptionText> options;
  std::vector<CommandText> subcommands;
};

/// Copyable. Values and actions must live as long as the program.
class Command {
 public:
  using Action = std::function<int()>;

  /// `chosen` receives the chosen command's action.
  Command(CLI::App& app, Action& chosen) : app_(&app), chosen_(&chosen) {}

  /// The user must name a subcommand unless the command `runs` by itself. Lists of commands show the description's
  /// first line.
  Command subcommand(const std::string& name, const std::string& description) const;
  /// The help shows its options under `heading`.
  Command group(const std::string& heading) const;
  /// `names`: `-o,--output`, or `file` for an argument. Rejects empty values. The help shows the default unless it
  /// is empty or the option is required. A bool is a flag. A transform is X Y Z (m) QW QX QY QZ.
  /// Throws: Error unless a transform is finite with a unit quaternion.
  template <typename Value>
  Option option(const std::string& names, Value& value, const std::string& help) const;
  bool given(const std::string& name) const;
  /// Options and subcommands so far.
  CommandText text() const;
  /// Sets the action, whose result is the exit code; void: 0.
  template <typename Does>
  void runs(Does does) const {
    if constexpr (std::is_void_v<std::invoke_result_t<Does>>) {
      set_action([does] {
        does();
        return 0;
      });
    } else {
      set_action(does);
    }
  }

 private:
  void set_action(const Action& action) const;

  CLI::App* app_;
  Action* chosen_;
  std::string group_ = "Options";
};

/// Returns the exit code; 2, with one line on stderr, for a wrong command line.
/// Throws: what the command throws.
int run_program(int argc, const char* const* argv, const std::function<void(Command program)>& add_commands);

void add_reproduce(Command program);
void add_run(Command program);
void add_record(Command program);
void add_render(Command program);
void add_track(Command program);
void add_score(Command program);
void add_robot_server(Command program);
void add_explain(Command program);
void add_db(Command program);
void add_import(Command program);
void add_generate(Command program);
void add_list(Command program);
void add_method(Command program);
void add_compare(Command program);
void add_table(Command program);
void add_gate(Command program);
void add_calibrate_cameras(Command calibrate);
void add_calibrate_colors(Command calibrate);
void add_calibrate_hand(Command calibrate);
void add_calibrate_noise(Command calibrate);
void add_completion(Command program);
void add_manual(Command program);

}  // namespace glovebench::eval
