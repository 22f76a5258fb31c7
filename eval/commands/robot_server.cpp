#include <fmt/format.h>

#include <memory>

#include "core/adapters/dds/dds_server.h"
#include "core/adapters/dds/security_keys.h"
#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "eval/commands/flags.h"
#include "eval/commands/robot_outputs.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

struct ServerFlags {
  BusFlags bus{.middleware = "dds", .interface = {}, .security = {}};
  std::string log;
  double max_log_age_s = kMaxLogAge;
  bool hand = false, arm = false;
  MountingFlag mounting;
  LimitsFlag limits;

  /// Serves until SIGINT or SIGTERM. Returns the exit code.
  int run() const {
    if (!hand && !arm) throw Error("robot-server run", "joints", "none", "--hand, --arm or both");
    const std::unique_ptr<ArmSolver> solver = arm ? require_arm_solver("robot-server run", "--arm") : nullptr;
    // Before the Interruption: opening a pipe may block forever.
    const DdsServerOptions read = options(solver.get());
    const Interruption interruption;
    const DdsServerSummary summary = serve(read);
    fmt::print("{}\n", summary.text);
    if (summary.lost_log_lines > 0)
      throw Error(log, "lines", fmt::format("{} that could not be written", summary.lost_log_lines),
                  "room for all");
    return 0;
  }

 private:
  DdsServerOptions options(const ArmSolver* solver) const {
    ServedRobot robot{hand, std::nullopt};
    if (solver) robot.arm = MountedArm{solver, mounting.T_flange_wrist()};
    return {.domain = bus.domain(),
            .access = bus.access("server"),
            .robot = robot,
            .log = log,
            .max_log_age_s = max_log_age_s,
            .limits = limits.limits(),
            .stopping = Interruption::wished,
            .tell = [](const std::string& line) { say("glovebench: {}\n", line); }};
  }
};

struct Keys {
  std::string folder;
  int days = 365;

  void make() const {
    constexpr int64_t kDay = 86'400;
    const int64_t now_s = system_us() / 1'000'000;
    make_security_keys(folder, {now_s - kDay, now_s + days * kDay});  // clocks of hosts differ
    fmt::print("{}: keys of", folder);
    for (const SecurityRole& role : security_roles()) fmt::print(" {}", role.name);
    fmt::print(", for {} days\n", days);
  }
};

}  // namespace

void add_robot_server(Command program) {
  const Command command = program.subcommand(
      "robot-server",
      "Take the commands of `track --robot` for hand and arm, keep them safe, say where the joints are.");
  const auto state = std::make_shared<ServerFlags>();
  const Command run = command.subcommand("run", "Serve until Ctrl-C.");
  run.option("--hand", state->hand, "the Shadow hand and its wrist");
  run.option("--arm", state->arm, "the PA-10 arm that carries the hand");
  state->bus.add(run, "where from: dds[:DOMAIN]");
  run.option("--log", state->log,
             "log to append to (*.jsonl), which also tells the next server where the joints stood")
      .named_file();
  run.option("--log-age", state->max_log_age_s,
             "seconds: a log whose last state is older is refused, for the joints may stand elsewhere")
      .in(0, 1e8);
  state->limits.add(run);
  state->mounting.add(run).needs("--arm");
  state->limits.add_coupling(run).needs("--hand");
  run.runs([state] { return state->run(); });
  const auto keys = std::make_shared<Keys>();
  const Command make_keys = command.subcommand("keys", "Make keys for DDS Security (`--security FOLDER`).");
  make_keys.option("folder", keys->folder, "folder to make").named_file().required();
  constexpr int kMostDays = 3650;
  make_keys.option("--days", keys->days, "for how long they shall hold").in(1, kMostDays);
  make_keys.runs([keys] { keys->make(); });
}

}  // namespace glovebench::eval
