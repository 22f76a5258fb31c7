#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "core/base/error.h"
#include "core/robot/server/server_log.h"
#include "eval/commands/command.h"
#include "eval/commands/robot_outputs.h"
#include "eval/interruption.h"
#ifdef GLOVEBENCH_DDS
#include "core/base/system_time.h"
#include "core/robot/arm_follower.h"
#include "core/robot/dds/dds_server.h"
#include "core/robot/dds/security_keys.h"
#endif
#ifdef GLOVEBENCH_ARM
#include "core/robot/arm/kdl_arm_solver.h"
#include "eval/say.h"
#endif

namespace glovebench::eval {
namespace {

struct RobotServer {
  BusFlags bus{.middleware = "dds", .interface = {}, .security = {}};
  std::string log;
  double max_log_age_s = kMaxLogAge;
  MountingFlag mounting;
  LimitsFlag limits;

  /// Serves until SIGINT or SIGTERM. Returns the exit code.
  int serve_hand() const {
#ifdef GLOVEBENCH_DDS
    const DdsServerOptions read = options("hand");  // before signals only ask: a pipe may never end
    const Interruption interruption;
    return finish(glovebench::serve_hand(read));
#else
    return bus.domain();  // throws
#endif
  }
  int serve_arm() const {
#if defined(GLOVEBENCH_DDS) && defined(GLOVEBENCH_ARM)
    const std::unique_ptr<ArmSolver> solver = make_kdl_arm_solver();
    const DdsServerOptions read = options("arm");
    const Interruption interruption;
    return finish(glovebench::serve_arm(read, *solver, mounting.T_flange_wrist(), kArmAtRest));
#else
    bus.domain();         // throws where that is missing
    throw Error("robot-server", "arm", "a glovebench that was built without Orocos KDL",
                "one that was configured with it (Debian: liborocos-kdl-dev)");
#endif
  }

 private:
#ifdef GLOVEBENCH_DDS
  DdsServerOptions options(const std::string& role) const {
    return {.domain = bus.domain(),
            .access = {bus.interface, bus.security, role},
            .log = log,
            .max_log_age_s = max_log_age_s,
            .limits = limits.limits(),
            .stopping = Interruption::wished,
            .tell = [](const std::string& line) { say("glovebench: {}\n", line); }};
  }
  int finish(const DdsServerSummary& summary) const {
    fmt::print("{}\n", summary.text);
    if (summary.lost_log_lines > 0)
      throw Error(log, "lines", fmt::format("{} that could not be written", summary.lost_log_lines),
                  "room for all");
    return 0;
  }
#endif
};

/// Keys for DDS Security.
struct Keys {
  std::string folder;
  int days = 365;

  void make() const {
#ifdef GLOVEBENCH_DDS
    constexpr int64_t kDay = 86'400;
    const int64_t now_s = system_us() / 1'000'000;
    make_security_keys(folder, {now_s - kDay, now_s + days * kDay});  // clocks of hosts differ
    fmt::print("{}: keys of", folder);
    for (const SecurityRole& role : security_roles()) fmt::print(" {}", role.name);
    fmt::print(", for {} days\n", days);
#else
    BusFlags{"dds", {}, {}}.domain();  // throws
#endif
  }
};

}  // namespace

void add_robot_server(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "robot-server",
      "Take the commands of `track --robot` for a hand or an arm, keep them safe, say where the joints are.");
  command->require_subcommand(1);
  const auto state = std::make_shared<RobotServer>();
  CLI::App* hand = command->add_subcommand("hand", "The Shadow hand and its wrist, until Ctrl-C.");
  CLI::App* arm = command->add_subcommand("arm", "The PA-10 arm that carries the hand, until Ctrl-C.");
  for (CLI::App* side : {hand, arm}) {
    state->bus.add(*side, "where from: dds[:DOMAIN]")->capture_default_str();
    side->add_option("--log", state->log,
                     "log to append to (*.jsonl), which also tells the next server where the joints stood")
        ->check(named_file());
    side->add_option("--log-age", state->max_log_age_s,
                     "seconds: a log whose last state is older is refused, for the joints may stand elsewhere")
        ->check(number_within(0, 1e8))
        ->capture_default_str();
    state->limits.add(*side);
  }
  state->mounting.add(*arm);
  state->limits.add_coupling(*hand);
  hand->callback([state, &exit_code] { exit_code = state->serve_hand(); });
  const auto keys = std::make_shared<Keys>();
  CLI::App* make_keys = command->add_subcommand("keys", "Make keys for DDS Security (`--security FOLDER`).");
  make_keys->add_option("folder", keys->folder, "folder to make")->check(named_file())->required();
  constexpr int kMostDays = 3650;
  make_keys->add_option("--days", keys->days, "for how long they shall hold")
      ->check(CLI::Range(1, kMostDays))
      ->capture_default_str();
  make_keys->callback([keys] { keys->make(); });
  arm->callback([state, &exit_code] { exit_code = state->serve_arm(); });
}

}  // namespace glovebench::eval
