#pragma once

#include <string>
#include <vector>

#include "eval/run.h"

namespace glovebench::eval {

/// What is run, and how.
struct Plan {
  TrackerConfig tracker;       ///< of all runs
  std::vector<RunSpec> specs;  ///< runs that show the same frames are neighbors
  std::string suite = {};      ///< the name of the suite that this is; empty if it is none
  bool quick = false;          ///< a few frames, to see that everything runs: nothing is concluded from them
};

struct Figure4Options {
  std::vector<std::string> trajectories;  ///< empty: all five
  std::vector<uint64_t> seeds = {1};
  std::vector<reports::NoiseSetting> noises = {{}};
  FrameRange frames;  ///< of each trajectory
};
/// The experiments of Figure 4: each ground truth with the databases that contain its grasp, against the recorded
/// and the source truth, and the latter with the second subject.
Plan plan_figure4(const TrackerConfig& tracker, const Figure4Options& options);

/// The experiments of a plan, one a line: name, frames x seeds.
std::string list_experiments(const Plan& plan);

/// What running the plan comes to: its experiments, seeds and frames, and which databases are there already. Builds
/// nothing.
std::string describe_plan(Workbench& workbench, const Plan& plan);

}  // namespace glovebench::eval
