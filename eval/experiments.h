#pragma once

#include <string>
#include <vector>

#include "eval/replay.h"

namespace glovebench::eval {

/// What is replayed, and how.
struct Plan {
  TrackerConfig tracker;
  std::vector<Replay> replays;
};

struct Figure4Options {
  std::vector<std::string> trajectories;  ///< empty: all five
  std::vector<uint64_t> seeds = {1};
  std::vector<reports::NoiseSetting> noises = {{}};
};
/// The experiments of Figure 4: each ground truth with the databases that contain its grasp, against the recorded
/// and the source truth, and the latter with the second subject.
Plan plan_figure4(const TrackerConfig& tracker, const Figure4Options& options);

struct Outcome {
  reports::RunResult result;
  reports::Timings timings;
};
/// Runs a plan on the workbench's threads. The result does not depend on their number. With `robot_folder`, the
/// robot commands of each experiment are written there as JSON Lines.
Outcome run_experiments(Workbench& workbench, const Plan& plan, const std::string& robot_folder = "");

}  // namespace glovebench::eval
