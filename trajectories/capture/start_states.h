#pragma once

#include <string>
#include <vector>

#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {

/// Size relative to `hand`: the median ratio of distances that no posture changes, else 1. `points`: a point or gap
/// for each frame and marker.
/// Throws: Error if no hand has this size.
double hand_scale(const CaptureHand& hand, const std::vector<std::vector<Eigen::Vector3d>>& points,
                  const std::string& where);

/// Guesses each frame from its neighbor, first the one with the most points.
/// Throws: Error if no frame has three palm points.
std::vector<HandState> start_states(const CaptureHand& hand,
                                    const std::vector<std::vector<Eigen::Vector3d>>& points, double robust_scale,
                                    const std::string& where);

}  // namespace glovebench::trajectories
