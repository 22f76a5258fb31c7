#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "core/base/error.h"
#include "eval/commands/options.h"
#include "eval/terminal.h"
#include "reports/results.h"

namespace {

constexpr int kUsageError = 2;
constexpr int kIncomparable = 3;
constexpr int kNoReader = 128 + SIGPIPE;  // as if the signal had ended the program

void add_commands(const glovebench::eval::Command& program) {
  using namespace glovebench::eval;
  add_reproduce(program);
  add_run(program);
  add_record(program);
  add_render(program);
  add_track(program);
  add_score(program);
  add_robot_server(program);
  add_explain(program);
  add_db(program);
  add_import(program);
  add_generate(program);
  add_list(program);
  add_method(program);
  add_compare(program);
  add_table(program);
  add_gate(program);
  const Command calibrate = program.subcommand("calibrate", "Measure what the tracker or the gate must know.");
  add_calibrate_cameras(calibrate);
  add_calibrate_colors(calibrate);
  add_calibrate_hand(calibrate);
  add_calibrate_noise(calibrate);
  add_completion(program);
  add_manual(program);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the size limit throws Error, like a full disk
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe must not end the work
  try {
    const int exit_code = glovebench::eval::run_program(argc, argv, add_commands);
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "cannot write to file");
    return exit_code;
  } catch (const glovebench::reports::Incomparable& e) {
    glovebench::eval::say("glovebench: {}\n", e.what());
    return kIncomparable;
  } catch (const glovebench::Error& e) {
    glovebench::eval::say("glovebench: {}\n", e.what());
    return kUsageError;
  } catch (const std::exception& e) {
    const auto* const failure = dynamic_cast<const std::system_error*>(&e);
    if (failure && failure->code() == std::errc::broken_pipe && std::ferror(stdout) != 0) return kNoReader;
    const char* const kind = std::ferror(stdout) != 0 ? "stdout" : "internal error";
    glovebench::eval::say("glovebench: {}: {}\n", kind, e.what());
    return kUsageError;
  }
}
