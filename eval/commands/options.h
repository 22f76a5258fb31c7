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

/// Says more about an option of a command. Each call returns the same option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required() const;
  /// Only numbers from `low` to `high`.
  Option in(double low, double high) const;
  Option not_negative() const;
  Option one_of(const std::vector<std::string>& words) const;
  /// Only names of files and folders, not `-`: for commands that print something else to standard output.
  Option named_file() const;
  Option existing_file() const;
  Option existing_folder() const;
  /// Of a list: exactly so many values.
  Option count(int values) const;
  /// Of a list: commas separate values, too.
  Option comma_separated() const;
  /// Only together with another option, which the command has already.
  Option needs(const std::string& other) const;

 private:
  CLI::Option* option_;
};

/// An option as a command declares it.
struct OptionText {
  std::vector<std::string> names;  ///< `-o`, `--output`; without dashes: an argument
  bool takes_value = true;
  std::string value;  ///< as the help writes it: type, range, default, what it needs
  std::string help;
  std::vector<std::string> words;  ///< the only values; empty: any
};

/// A command as it is declared, for its man page and for the completion of a shell.
struct CommandText {
  std::string name;
  std::string description;
  std::vector<OptionText> options;
  std::vector<CommandText> subcommands;
};

/// A command of the program, or the program itself: a handle, which may be copied. Values and actions that are
/// given to it must live as long as the program runs.
class Command {
 public:
  using Action = std::function<int()>;

  /// `chosen` is where the action goes of the command that the command line names.
  Command(CLI::App& app, Action& chosen) : app_(&app), chosen_(&chosen) {}

  /// Adds a command. A command that has others needs one of them on the command line.
  Command subcommand(const std::string& name, const std::string& description) const;
  /// Adds an option, whose value is written to `value`. `names` is `-o,--output`, or `file` for an argument without
  /// a flag. An empty value is an error. The help shows the default unless it is empty or the option is required. A
  /// bool is a flag. A transform is seven numbers, X Y Z (m) QW QX QY QZ; throws Error when it is read unless all
  /// are finite and the quaternion has unit length. Other types: int, uint64_t, double, std::string, optional
  /// numbers, and lists (std::vector) of strings and doubles.
  template <typename Value>
  Option option(const std::string& names, Value& value, const std::string& help) const;
  /// Whether the command line names the option.
  bool given(const std::string& name) const;
  /// What is declared by now, subcommands too.
  CommandText text() const;
  /// What the command does, once the whole command line is read. The exit code is what it returns, 0 if nothing.
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
};

/// Reads the command line of glovebench, whose commands `add_commands` adds, and does what it says. Returns the
/// exit code; 2 and a line on stderr if the command line is wrong. Throws what the command throws.
int run_program(int argc, const char* const* argv, const std::function<void(Command program)>& add_commands);

// Each adds one command, in the file of its name.
void add_reproduce(Command program);
void add_run(Command program);
void add_record(Command program);
void add_render(Command program);
void add_track(Command program);
void add_robot_server(Command program);
void add_explain(Command program);
void add_db(Command program);
void add_import(Command program);
void add_generate(Command program);
void add_list(Command program);
void add_compare(Command program);
void add_gate(Command program);
void add_calibrate_cameras(Command calibrate);
void add_calibrate_colors(Command calibrate);
void add_calibrate_noise(Command calibrate);
void add_completion(Command program);
void add_manual(Command program);

}  // namespace glovebench::eval
