#include <fmt/format.h>

#include <cstdio>
#include <set>

#include "core/base/error.h"
#include "eval/commands/command.h"
#include "eval/experiments.h"
#include "reports/paper_numbers.h"
#include "reports/tables.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

struct Reproduce {
  CommonFlags common;
  Figure4Options figure4;
  int seed_count = 1;
  bool all_gains = false;
  RobotFlags robot;

  void run() {
    std::set<std::string> once(figure4.trajectories.begin(), figure4.trajectories.end());
    if (once.size() != figure4.trajectories.size()) {
      throw Error("--trajectory", "names", "one of them twice", "each once");
    }
    common.tracker_config();  // a wrong configuration is named before anything is built
    if (common.output.empty()) common.output = "out";
    common.check_output_folder();
    for (int s = 0; s < seed_count; ++s) figure4.seeds.push_back(common.seed + s);
    figure4.noises = {{"gradient", 1}};
    if (all_gains) figure4.noises = {{"gradient", 1}, {"gradient", 0.5}, {"gradient", 2}, {"kinect", 1}};

    Workbench workbench = common.workbench();
    const Plan plan = plan_figure4(common.tracker_config(), figure4);
    const Outcome outcome = run_into_folder(workbench, plan, {robot.output, robot.T_base_camera()}, common.output);
    for (const reports::NoiseSetting& noise : figure4.noises) {
      if (all_gains) fmt::print("Depth noise: {} x{}\n", noise.model, noise.factor);
      fmt::print("{}\n", reports::figure4_table(outcome.result, reports::paper_numbers(), noise));
    }
    fmt::print("{:.0f} s, {} threads. Report: {}/index.html\n", outcome.timings.wall_s, outcome.timings.threads,
               common.output);
  }
};

}  // namespace

void add_reproduce(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("reproduce",
                             "Run the paper's experiments (figures 4 to 6) and write the report.\n"
                             "Five trajectories x the databases that hold their grasp = 15 experiments, each "
                             "against the recorded truth, the\n"
                             "source truth, and the source with a second subject's hand in front of the camera.");
  const auto state = std::make_shared<Reproduce>();
  state->figure4.seeds.clear();
  state->common.add_output(*command, "folder of the report [out]");
  state->common.add_tracker(*command);
  state->common.add_seed(*command);
  state->common.add_machine(*command);
  command->add_option("--trajectory", state->figure4.trajectories, "only these, e.g. Tr4")
      ->check(CLI::IsMember(trajectories::ground_truth_names()));
  command->add_option("--seeds", state->seed_count, "noise seeds an experiment, counted up from --seed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--all-noise", state->all_gains, "also half and double noise gain, and the kinect noise model");
  state->robot.add(*command, "folder for the robot commands of each experiment");
  command->callback([state] { state->run(); });
}

}  // namespace glovebench::eval
