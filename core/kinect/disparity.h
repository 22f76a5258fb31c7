#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

/// Kinect v1 depth as the device reports it: z_mm = 345489 / (1089.41 - raw), from f 575.816 px, baseline
/// 75 mm, 1/8 px steps. raw 0 is 317 mm, 398 is 500 mm, 744 is 1000 mm.
inline constexpr uint16_t kNoDisparity = 2047;
inline constexpr uint16_t kMaxDisparity = 1083;  ///< from 1084 on the formula has no useful value

/// Depth in metres, or 0 for 2047 and for anything from 1084 on.
float depth_from_disparity(uint16_t raw);
/// The nearest 11-bit step, or kNoDisparity if z (metres) is not positive, not finite or out of range.
uint16_t disparity_from_depth(double z);

/// The same by a calibration of one's own, or by the formula above if there is none. Then, too, 2047 has no depth,
/// nor has what the line puts behind the camera or farther away than the formula reaches (54 m).
using OptionalLine = std::optional<DisparityLine>;
float depth_from_disparity(uint16_t raw, const OptionalLine& line);
uint16_t disparity_from_depth(double z, const OptionalLine& line);

DepthImage depth_from_disparity(const Image<uint16_t>& raw);
/// Of a whole image, 0 also for what is farther than `z_max` (m).
DepthImage depth_from_disparity(const Image<uint16_t>& raw, const OptionalLine& line,
                                double z_max = std::numeric_limits<double>::infinity());

}  // namespace glovebench
