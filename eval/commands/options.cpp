// The only source that includes CLI11, which takes long to compile.
#include "eval/commands/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "eval/commands/help.h"
#include "eval/program.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr int kWrongCommandLine = 2;
/// Ends the name of a group whose options are rare; CLI11 keeps nothing else of an option for its user.
constexpr std::string_view kRare = " (rare)";

/// An empty value usually comes from an unset variable of a script.
CLI::Validator not_empty() {
  return {
      [](const std::string& text) -> std::string { return text.empty() ? "found nothing, expected a value" : ""; },
      ""};
}

/// Accepts numbers from `low` to `high`; CLI::Range also accepts text that is no number.
CLI::Validator number_within(double low, double high) {
  return {[=](const std::string& text) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
            return fmt::format("found {}, expected a number from {} to {}", printable(text), low, high);
          },
          fmt::format("[{} - {}]", low, high)};
}

/// CLI11 would read 010 as 8, and clamp numbers that are too large.
template <typename Number>
CLI::Validator whole_number() {
  return {[](const std::string& text) -> std::string {
            Number number = 0;
            const char* const end = text.data() + text.size();
            const auto read = std::from_chars(text.data(), end, number);
            const std::string_view digits = std::string_view(text).substr(text.starts_with("-"));
            const bool is_decimal = !digits.starts_with("0") || digits == "0";
            if (read.ec == std::errc() && read.ptr == end && is_decimal) return {};
            if (read.ec != std::errc::result_out_of_range)
              return fmt::format("found {}, expected a whole number", printable(text));
            return fmt::format("found {}, expected a whole number from {} to {}", printable(text),
                               std::numeric_limits<Number>::min(), std::numeric_limits<Number>::max());
          },
          ""};
}

Eigen::Isometry3d rigid_transform(const std::string& flag, const std::vector<double>& values) {
  for (const double value : values)
    if (!std::isfinite(value)) throw Error(flag, "transform", fmt::format("{}", value), "finite numbers");
  const Eigen::Quaterniond q(values[3], values[4], values[5], values[6]);
  if (!(std::abs(q.norm() - 1) < 1e-3))
    throw Error(flag, "length of the quaternion", fmt::format("{}", q.norm()), "1");
  return Eigen::Translation3d(values[0], values[1], values[2]) * q.normalized();
}

template <typename Value>
struct WithoutOptional {
  using Type = Value;
};
template <typename Value>
struct WithoutOptional<std::optional<Value>> {
  using Type = Value;
};

template <typename Value>
bool is_empty(const Value& value) {
  if constexpr (requires { value.empty(); }) return value.empty();
  if constexpr (requires { value.has_value(); }) return !value.has_value();
  return false;
}

/// The words of `one_of`. CLI11 keeps them only in the type: TEXT:{slow,fast}.
std::vector<std::string> words_of(const std::string& type) {
  const size_t begin = type.find(":{"), end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 2, end - begin - 2), ',');
}

/// CLI11 says "..." of any option that takes several values.
std::string with_how_often(std::string value, const CLI::Option& option) {
  const size_t several = value.find(" ...");
  if (several == std::string::npos || option.get_positional()) return value;
  if (option.get_delimiter() == ',') return value.replace(several, 4, "[,...]");
  return option.get_allow_extra_args() ? value : value.replace(several, 4, " (repeatable)");
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (text.names.empty()) text.names.push_back(option.get_name());
  text.takes_value = option.get_type_size() > 0;
  text.value = with_how_often(CLI::detail::trim_copy(CLI::Formatter().make_option_opts(&option)), option);
  text.help = option.get_description();
  text.words = words_of(option.get_type_name());
  text.is_rare = option.get_group().ends_with(kRare);
  text.group = option.get_group().substr(0, option.get_group().size() - (text.is_rare ? kRare.size() : 0));
  return text;
}

CommandText text_of(const CLI::App& app) {
  CommandText text{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) text.options.push_back(text_of(*option));
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    text.subcommands.push_back(text_of(*subcommand));
  return text;
}

/// For `app` as --help, for `all` as --help-all, which also shows the help of all commands under it.
std::string help_of(const CLI::App& app, const std::string& name, bool all) {
  CLI::Formatter formatter;
  formatter.label("SUBCOMMAND", "COMMAND");
  std::string help = help_text(text_of(app), formatter.make_usage(&app, name), all, terminal_columns());
  if (!all) return help;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    help += "\n" + help_of(*subcommand, name + " " + subcommand->get_name(), all);
  return help;
}

/// What is wrong and where help is. CLI11 reports a missing command or option before the misspelled one that causes
/// it. `name` is the command's with its parents.
std::string describe(const CLI::App& command, const std::string& name, const CLI::ParseError& error) {
  const std::vector<std::string> words = command.remaining();
  const auto unknown = std::ranges::find_if(words, [](const std::string& word) { return word != "--"; });
  if (unknown != words.end())
    return fmt::format("{} (see {} --help)", describe_unknown(text_of(command), *unknown), name);
  if (const auto chosen = command.get_subcommands(); !chosen.empty())
    return describe(*chosen.front(), name + " " + chosen.front()->get_name(), error);
  std::string problem = error.what();
  if (const size_t at = problem.find("subcommand"); at != std::string::npos) problem.erase(at, 3);  // CLI11's word
  return fmt::format("{} (see {} --help)", problem, name);
}

}  // namespace

Option Option::required() const {
  option_->required()->default_str("");
  return *this;
}

Option Option::in(double low, double high) const {
  option_->check(number_within(low, high));
  return *this;
}

Option Option::not_negative() const {
  const auto problem = [](const std::string& text) -> std::string {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= 0) return {};
    return fmt::format("found {}, expected 0 or more", printable(text));
  };
  option_->check(CLI::Validator(problem, "NONNEGATIVE"));
  return *this;
}

Option Option::one_of(const std::vector<std::string>& words) const {
  const auto problem = [words](const std::string& text) -> std::string {
    if (std::ranges::find(words, text) != words.end()) return "";
    return fmt::format("found {}, expected {}", printable(text), glovebench::one_of(words, text));
  };
  option_->check(CLI::Validator(problem, fmt::format("{{{}}}", fmt::join(words, ","))));
  return *this;
}

Option Option::named_file() const {
  const auto problem = [](const std::string& text) -> std::string {
    return text == "-" ? "found -, expected the name of a file or folder" : "";
  };
  option_->check(CLI::Validator(problem, ""));
  return *this;
}

Option Option::existing_file() const {
  option_->check(CLI::ExistingFile);
  return *this;
}

Option Option::existing_folder() const {
  option_->check(CLI::ExistingDirectory);
  return *this;
}

Option Option::count(int values) const {
  option_->expected(values);
  return *this;
}

Option Option::repeated() const {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::comma_separated() const {
  option_->delimiter(',');
  return *this;
}

Option Option::needs(const std::string& other) const {
  option_->needs(other);
  return *this;
}

Option Option::rare() const {
  option_->group(option_->get_group() + std::string(kRare));
  return *this;
}

Command Command::subcommand(const std::string& name, const std::string& description) const {
  app_->require_subcommand(1);
  return {*app_->add_subcommand(name, description), *chosen_};
}

Command Command::group(const std::string& heading) const {
  Command command = *this;
  command.group_ = heading;
  return command;
}

template <typename Value>
Option Command::option(const std::string& names, Value& value, const std::string& help) const {
  CLI::Option* added = nullptr;
  if constexpr (std::is_same_v<Value, bool>) {
    added = app_->add_flag(names, value, help);
  } else if constexpr (std::is_same_v<Value, std::optional<Eigen::Isometry3d>>) {
    const auto read = [names, &value](const std::vector<double>& values) {
      value = rigid_transform(names, values);
    };
    added = app_->add_option_function<std::vector<double>>(names, read, help)->expected(7)->check(not_empty());
  } else {
    added = app_->add_option(names, value, help)->check(not_empty());
    if (!is_empty(value)) added->capture_default_str();
    using Number = typename WithoutOptional<Value>::Type;
    if constexpr (std::is_integral_v<Number>) added->check(whole_number<Number>());
  }
  return Option(*added->group(group_));
}

// The types of values.
template Option Command::option(const std::string&, bool&, const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, uint64_t&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<uint64_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<Eigen::Isometry3d>&, const std::string&) const;

bool Command::given(const std::string& name) const { return app_->count(name) > 0; }

CommandText Command::text() const { return text_of(std::as_const(*app_)); }

void Command::set_action(const Action& action) const {
  if (app_->get_require_subcommand_min() > 0) app_->require_subcommand(0, 1);
  app_->callback([app = app_, chosen = chosen_, action] {
    if (app->get_subcommands().empty()) *chosen = action;
  });
}

int run_program(int argc, const char* const* argv, const std::function<void(Command)>& add_commands) {
  CLI::App program(
      "Evaluation and benchmarking of color-glove hand tracking with an RGB-D camera (Schroeder et al. 2012).\n"
      "Exit codes: 0 fine, 1 a gate or claim failed, 2 usage or input error, 3 incomplete or not comparable.",
      "glovebench");
  program.set_version_flag("--version",
                           fmt::format("glovebench {} ({})", program_info().version, program_info().commit));
  program.formatter_fn([](const CLI::App* app, const std::string& name, CLI::AppFormatMode mode) {
    return help_of(*app, name, mode == CLI::AppFormatMode::All);
  });
  program.set_help_all_flag("--help-all", "Print also what is rarely needed, and exit");
  Command::Action chosen;
  add_commands({program, chosen});
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return program.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    say("glovebench: {}\n", describe(program, program.get_name(), e));
    return kWrongCommandLine;
  }
  return chosen();
}

}  // namespace glovebench::eval
