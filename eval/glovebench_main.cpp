#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "core/base/error.h"
#include "eval/commands/command.h"
#include "eval/program_info.h"
#include "eval/terminal.h"
#include "reports/comparison/pairing.h"

namespace {

constexpr int kUsageError = 2;
constexpr int kIncomparable = 3;

/// What is wrong with the command line. CLI11 tells a missing subcommand or option before an unknown one, which
/// hides the misspelling that it comes from.
std::string describe(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = program.remaining(true);
  const bool missing = error.get_name() == "RequiredError";
  return missing && !unknown.empty() ? fmt::format("{}: unknown argument or subcommand", unknown.front())
                                     : error.what();
}

int run(int argc, char** argv) {
  CLI::App program(
      "Evaluation and benchmarking of color-glove hand tracking with an RGB-D camera (Schroeder et al. 2012).\n"
      "Exit codes: 0 fine, 1 a gate or claim failed, 2 usage or input error, 3 incomplete or not comparable.",
      "glovebench");
  const auto& info = glovebench::eval::program_info();
  program.set_version_flag("--version", fmt::format("glovebench {} ({})", info.version, info.commit));
  program.require_subcommand(1);
  program.get_formatter()->column_width(34);

  int exit_code = 0;
  glovebench::eval::add_reproduce(program, exit_code);
  glovebench::eval::add_run(program);
  glovebench::eval::add_record(program);
  glovebench::eval::add_render(program);
  glovebench::eval::add_track(program);
  glovebench::eval::add_robot_server(program, exit_code);
  glovebench::eval::add_explain(program);
  glovebench::eval::add_db(program);
  glovebench::eval::add_import(program);
  glovebench::eval::add_list(program);
  glovebench::eval::add_compare(program);
  glovebench::eval::add_gate(program, exit_code);
  glovebench::eval::add_calibrate(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return program.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    glovebench::eval::say("glovebench: {} (see glovebench --help)\n", describe(program, e));
    return kUsageError;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the size limit is an Error like a full disk
  std::signal(SIGPIPE, SIG_IGN);  // whoever stops reading what is said ends no work
  try {
    const int exit_code = run(argc, argv);
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "cannot write to file");
    return exit_code;
  } catch (const glovebench::reports::Incomparable& e) {
    glovebench::eval::say("glovebench: {}\n", e.what());
    return kIncomparable;
  } catch (const glovebench::Error& e) {
    glovebench::eval::say("glovebench: {}\n", e.what());
    return kUsageError;
  } catch (const std::exception& e) {
    const char* const kind = std::ferror(stdout) != 0 ? "stdout" : "internal error";
    glovebench::eval::say("glovebench: {}: {}\n", kind, e.what());
    return kUsageError;
  }
}
