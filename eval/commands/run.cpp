#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "eval/commands/command.h"
#include "eval/experiments.h"
#include "eval/explain.h"
#include "eval/share.h"
#include "reports/paper_numbers.h"
#include "reports/report.h"
#include "reports/summary.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using trajectories::Trajectory;

struct Run {
  CommonFlags common;
  std::vector<std::string> trajectory_names;
  std::vector<std::string> databases;
  std::string truth = "source";
  std::string noise = "gradient";
  double gain = 1;
  int subject = 1;
  int seed_count = 1;
  RobotFlags robot;

  void run() {
    // A range check lets it pass.
    if (std::isnan(gain)) throw Error("--gain", "value", "nan", "a number from 0 to 100");
    Plan plan{common.tracker_config(), {}};
    for (const std::string& name : trajectory_names) {
      const auto trajectory = std::make_shared<const Trajectory>(load(name));
      common.left = trajectory->side == Side::left;
      if (!plan.replays.empty() && plan.replays.front().truth->side != trajectory->side) {
        throw Error(name, "side", common.left ? "left" : "right", "that of the run's other trajectories");
      }
      for (const Replay& other : plan.replays) {
        if (other.truth->name == trajectory->name)
          throw Error(name, "name", trajectory->name, "one not yet in the run");
      }
      for (int s = 0; s < seed_count; ++s) {
        plan.replays.push_back({trajectory, subject, {noise, gain}, common.seed + s, {}});
      }
    }
    common.check_output_folder();
    Workbench workbench = common.workbench();
    std::vector<std::string> names;
    for (const std::string& database : databases) {
      names.push_back(workbench.add_database(database));
      if (std::count(names.begin(), names.end(), names.back()) > 1) {
        throw Error("--database", "name", names.back(), "one not yet in the run");
      }
    }
    for (Replay& replay : plan.replays) replay.databases = names;
    const Outcome outcome = run_experiments(workbench, plan, {robot.output, robot.T_base_camera()});
    reports::write_report(common.output, outcome.result, outcome.timings, sample_pictures(workbench, plan));
    fmt::print("{}", reports::to_markdown(reports::detail_summary(outcome.result)));
    fmt::print("{:.1f} s, {} threads. Report: {}/index.html\n", outcome.timings.wall_s, outcome.timings.threads,
               common.output);
  }

  Trajectory load(const std::string& name) const {
    if (name.ends_with(".json")) return trajectories::load_trajectory(name);
    return truth == "recorded" ? trajectories::recorded_trajectory(trajectory_folder(), name)
                               : trajectories::source_trajectory(trajectory_folder(), name);
  }
};

}  // namespace

void add_run(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "run", "Replay trajectories, also your own, through the tracker and report the errors.");
  const auto state = std::make_shared<Run>();
  state->common.add_output(*command, "folder of the report", true);
  command
      ->add_option("--trajectory", state->trajectory_names, "Tr1..Tr5, or a file (*.json; trajectories/README.md)")
      ->required();
  command
      ->add_option("--database", state->databases,
                   "to track against: names (`glovebench list databases`) or files (*.glovedb, *.csv, *.json)")
      ->required();
  command->add_option("--truth", state->truth, "which truth of Tr1..Tr5")
      ->check(CLI::IsMember({"source", "recorded"}))
      ->capture_default_str();
  command->add_option("--noise", state->noise, "depth noise")
      ->check(CLI::IsMember({"gradient", "kinect", "none"}))
      ->capture_default_str();
  command->add_option("--gain", state->gain, "factor on the noise's gain")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--subject", state->subject, "whose hand is in front of the camera; the tracker's own is 1")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
  command->add_option("--seeds", state->seed_count, "noise seeds an experiment, counted up from --seed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  state->robot.add(*command, "folder for the robot commands of each experiment");
  state->common.add_tracker(*command);
  state->common.add_seed(*command);
  state->common.add_machine(*command);
  command->callback([state] { state->run(); });
}

}  // namespace glovebench::eval
