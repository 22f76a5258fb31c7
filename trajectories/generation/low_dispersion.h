#pragma once

#include <vector>

#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// Indices into `pool`, each farthest (posture_distance) from `given` and earlier ones. Ties: the lower index.
/// Throws: Error if the pool is too small or `given` is empty.
/// Paper: section III, reference 1.
std::vector<size_t> low_dispersion_sample(const std::vector<Posture>& pool, const std::vector<Posture>& given,
                                          size_t count);

/// Largest distance from a pool posture to the chosen ones, rad.
/// Throws: Error if either is empty.
double covering_radius(const std::vector<Posture>& pool, const std::vector<Posture>& chosen);

}  // namespace glovebench::trajectories
