#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "reports/results.h"

namespace glovebench::reports {

/// What two results are compared in. Of every quantity, less is better.
struct Quantity {
  std::string_view key;   ///< with its unit
  std::string_view unit;  ///< "mm", "deg", "%"
  bool is_share;          ///< of frames: each counts 0 or 100; otherwise a mean over the frames that have a value
  double default_minimum_effect;  ///< where no noise floor was measured, in the quantity's unit
  double tolerance;  ///< between machines (a result that was computed elsewhere), in the quantity's unit
};
inline constexpr int kQuantityCount = 10;
/// position_error_mm, rotation_error_deg, posture_rms_deg, posture_rms_unfiltered_deg, vertex_error_mm,
/// fingertip_error_mm, uncovered_percent, false_tracked_percent, false_lost_percent,
/// icp_residual_mm. The last is a fit, not an error against the truth: noise of the sensor, which the pose averages
/// out, and an alignment that stops early show there first.
const std::array<Quantity, kQuantityCount>& quantities();
/// The value of one frame; empty if it has none. Shares have one for every frame.
std::optional<double> value_of(const Quantity& quantity, const FrameRecord& frame);

}  // namespace glovebench::reports
