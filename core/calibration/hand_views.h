#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "core/methods/method.h"
#include "core/tracker/hand_view.h"

namespace glovebench::calibration {

/// A frame in which the hand was tracked.
struct TrackedView {
  int64_t timestamp_us = 0;
  HandView seen;
  ArticulatedPose pose;  ///< as a hand of other sizes was tracked: where the fit begins
};
/// What a frame shows of the hand that was tracked in it; empty if it was lost. `inputs`: of the method.
std::optional<TrackedView> view_of(const DeviceFrame& frame, const TrackResult& result, const MethodInputs& inputs);

/// How a hand moved in the views of it.
struct ShownMotion {
  int views = 0;
  double seconds = 0;                ///< from the first to the last
  double turn_deg = 0;               ///< the largest angle between two directions from which the hand is seen
  std::array<double, 5> bend_deg{};  ///< thumb to little: how far the two middle joints bend and stretch together
};
ShownMotion motion_of(std::span<const TrackedView> views);
/// Throws Error, naming `where`, unless there are enough views, the fingers open and close, and the hand turns.
void require_motion(const ShownMotion& motion, const std::string& where);

}  // namespace glovebench::calibration
