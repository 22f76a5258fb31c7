#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "eval/run.h"

namespace glovebench::eval {

/// Measures the answers that a live system uses, at eight moments a frame.
struct Streaming {
  std::optional<double> tracker_ms = {};  ///< time of each frame; empty: as measured
};

struct Plan {
  TrackerConfig tracker;
  std::vector<RunSpec> specs;                        ///< runs of the same frames are successive
  std::string suite = {};                            ///< empty: none
  bool quick = false;                                ///< few frames; no conclusions
  std::string association = "by time stamp, exact";  ///< of estimates to truths
  nlohmann::json score = {};                         ///< configuration of `score`; null: a tracker's plan
  std::optional<Streaming> streaming = {};

  /// True if frame times are results. Then one job runs at a time.
  bool times_frames() const { return streaming && !streaming->tracker_ms; }
};

struct Figure4Options {
  std::vector<std::string> trajectories;  ///< empty: all five
  std::vector<uint64_t> seeds = {1};
  std::vector<reports::NoiseSetting> noises = {{}};
  FrameRange frames;
};
/// The databases of each grasp on recorded truth, source truth, and source truth with subject 2.
/// Paper: Figure 4.
Plan plan_figure4(const TrackerConfig& tracker, const Figure4Options& options);

std::string list_experiments(const Plan& plan);

/// Experiments, seeds, frames, and existing databases. Builds nothing.
std::string describe_plan(Workbench& workbench, const Plan& plan);

}  // namespace glovebench::eval
