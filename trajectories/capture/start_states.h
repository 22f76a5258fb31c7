#pragma once

#include <string>
#include <vector>

#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {

/// How large the captured hand is, relative to `hand`: the median ratio of distances that no posture changes. 1 if
/// there is no such pair. `points`: of each frame, one a marker, or a gap. Throws Error if it is no hand's size.
double hand_scale(const CaptureHand& hand, const std::vector<std::vector<Eigen::Vector3d>>& points,
                  const std::string& where);

/// A first guess of every frame: from the frame with the most points on, forth and back, each from its neighbor,
/// the pose by the points of the palm where they show it. Where that does not fit, other postures are tried. Throws
/// Error if no frame has three points of the palm.
std::vector<HandState> start_states(const CaptureHand& hand,
                                    const std::vector<std::vector<Eigen::Vector3d>>& points, double robust_scale,
                                    const std::string& where);

}  // namespace glovebench::trajectories
