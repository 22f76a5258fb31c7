#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/cloud/labeled_cloud.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

// Valid values that are most likely a mistake of units: one sentence each, that names the likely cause.

/// Empty unless the angles, which files hold in degrees, look like radians.
std::string angle_doubt(std::span<const Posture> postures);

/// `angle_doubt`, and whether more than half of the frames lie nearer or farther than the working volume.
std::vector<std::string> unit_doubts(const Trajectory& trajectory, const WorkingVolume& volume);

}  // namespace glovebench::trajectories
