#pragma once

#include <vector>

#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// Low-dispersion sampling (section III; after [1] of the paper): the indices of `count` postures of the pool, each
/// the one farthest (posture_distance) from those chosen before it and from `given`. Ties go to the lower index.
/// Throws Error if the pool has fewer than `count` postures or `given` is empty.
std::vector<size_t> low_dispersion_sample(const std::vector<Posture>& pool, const std::vector<Posture>& given,
                                          size_t count);

/// The dispersion of `chosen` in the pool: the largest distance from a posture of the pool to its nearest chosen
/// one, radians. Throws Error if either is empty.
double covering_radius(const std::vector<Posture>& pool, const std::vector<Posture>& chosen);

}  // namespace glovebench::trajectories
