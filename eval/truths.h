#pragma once

#include <memory>

#include "reports/results.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// The truth of an experiment among the program's own trajectories; null if it was a file of the user's. Throws
/// Error if the data folder is damaged.
std::shared_ptr<const trajectories::Trajectory> find_truth(const reports::ExperimentKey& key);

}  // namespace glovebench::eval
