#pragma once

#include "eval/workbench.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// Renders with subject 1 and `kinect` noise, tracks, returns smoothed estimates.
/// Throws: Error if a frame is lost.
/// Paper: section IV.
trajectories::Trajectory record_truth(Workbench& workbench, const trajectories::Trajectory& source,
                                      const std::string& database, const TrackerConfig& config, uint64_t seed);

}  // namespace glovebench::eval
