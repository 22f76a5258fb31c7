#pragma once

#include <memory>

#include "reports/results.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// Null for a user's file.
/// Throws: Error if the data folder is damaged.
std::shared_ptr<const trajectories::Trajectory> find_truth(const reports::ExperimentKey& key);

}  // namespace glovebench::eval
