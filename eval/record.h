#pragma once

#include "eval/workbench.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// The paper's ground truth (section IV): the source is rendered with the first subject's hand and `gradient`
/// noise, tracked, and the tracker's output, smoothed as always, becomes the truth. Throws Error if a frame is
/// lost.
trajectories::Trajectory record_truth(Workbench& workbench, const trajectories::Trajectory& source,
                                      const std::string& database, const TrackerConfig& config, uint64_t seed);

}  // namespace glovebench::eval
