#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "core/methods/method.h"
#include "core/pose/articulated_fit.h"
#include "core/tracker/sighting.h"

namespace glovebench::calibration {

struct TrackedView {
  int64_t timestamp_us = 0;
  HandView seen;
  ArticulatedPose pose;  ///< the fit starts here
};
/// Empty if the hand was lost or cut by the border.
std::optional<TrackedView> view_of(const DeviceFrame& frame, const TrackResult& result, const MethodInputs& inputs);

/// From the hand to the camera, hand frame.
Eigen::Vector3d view_direction(const ArticulatedPose& pose);

struct ShownMotion {
  int views = 0;
  double seconds = 0;                ///< first to last view
  double turn_deg = 0;               ///< largest between viewing directions
  std::array<double, 5> bend_deg{};  ///< thumb to little: range of both middle joints' bend
};
ShownMotion motion_of(std::span<const TrackedView> views);
/// Throws: Error unless views suffice, the fingers open and close, and the hand turns.
void require_motion(const ShownMotion& motion, const std::string& where);

}  // namespace glovebench::calibration
