#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/robot/command_guard.h"
#include "eval/run.h"
#include "reports/estimates.h"

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

struct Outcome {
  reports::RunResult result;
  reports::Timings timings;
  std::vector<reports::ExperimentEstimates> estimates;
};
/// How the robot commands of each experiment are made, and where they are written; an empty folder: nowhere.
struct RobotOutput {
  std::string folder = {};
  RobotSetup setup = {};
  CommandLimits limits = {};
  nlohmann::json configuration = {};  ///< all of that, for the results'; null: nothing is said of it
};

/// Runs a plan on the workbench's threads. The result does not depend on their number. The robot commands of each
/// experiment are measured, and with a robot folder written there as JSON Lines. With a store, runs that an
/// interrupted program finished are taken from it, and each that is finished is stored in it.
Outcome run_experiments(Workbench& workbench, const Plan& plan, const RobotOutput& robot = {},
                        RunStore* store = nullptr);

/// Runs studies beside the experiments.
using RunStudies = std::function<std::vector<reports::StudyResult>(RunStore& store)>;
/// The same, with its report: locks and marks the folder, runs plan and studies or what is left of them after a
/// kill, writes the report, and takes the mark away.
Outcome run_into_folder(Workbench& workbench, const Plan& plan, const RobotOutput& robot, const std::string& folder,
                        const RunStudies& run_studies = {});

}  // namespace glovebench::eval
