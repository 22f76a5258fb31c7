#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/image.h"
#include "core/kinect/device.h"

namespace glovebench {

/// Kinect v1: z_mm = 345489 / (1089.41 - raw): f 575.816 px, baseline 75 mm, steps of 1/8 px.
inline constexpr uint16_t kNoDisparity = 2047;
inline constexpr uint16_t kMaxDisparity = 1083;  ///< largest with a useful depth

/// m; 0 above kMaxDisparity.
float depth_from_disparity(uint16_t raw);
/// Nearest step. kNoDisparity unless z (m) is finite, positive and in range.
uint16_t disparity_from_depth(double z);

/// Empty: formula above. No depth outside 0..54 m.
using OptionalLine = std::optional<DisparityLine>;
float depth_from_disparity(uint16_t raw, const OptionalLine& line);
uint16_t disparity_from_depth(double z, const OptionalLine& line);

DepthImage depth_from_disparity(const Image<uint16_t>& raw);
/// Drops depth beyond `z_max` (m).
DepthImage depth_from_disparity(const Image<uint16_t>& raw, const OptionalLine& line,
                                double z_max = std::numeric_limits<double>::infinity());
/// Converts a frame's disparity, or takes the depth that the device measured.
DepthImage depth_of(const DeviceFrame& frame, const OptionalLine& line,
                    double z_max = std::numeric_limits<double>::infinity());

}  // namespace glovebench
