#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/cloud/labeled_cloud.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

// A sentence for each likely mistake of units in valid values.

/// Empty unless angles look like radians; files hold degrees.
std::string angle_doubt(std::span<const Posture> postures);

/// `angle_doubt`, and if more than half of the frames lie outside the working volume's depths.
std::vector<std::string> unit_doubts(const Trajectory& trajectory, const WorkingVolume& volume);

}  // namespace glovebench::trajectories
