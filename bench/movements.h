#pragma once

#include <string>
#include <vector>

#include "render/synthetic_kinect.h"

namespace glovebench::bench {

struct Movement {
  std::string name;
  std::vector<HandFrame> frames;  ///< some of its frames
};

/// Every 19th frame of the five source trajectories: 37 frames of open hand, grasp and between. The width of the
/// robust alignment was chosen on these.
std::vector<Movement> tuned_movements(const std::string& trajectory_folder);

/// The same of ten movements between random blends of two gestures, on random ways within the ranges of the five:
/// 70 frames on which nothing is tuned. The same ones each time. The gestures are those that the five and the
/// databases are made of, too.
std::vector<Movement> held_out_movements(const std::string& trajectory_folder);

}  // namespace glovebench::bench
