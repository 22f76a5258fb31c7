#pragma once

#include <string>
#include <string_view>

#include "core/kinect/disparity.h"
#include "core/methods/method.h"
#include "core/tracker/track_result.h"

namespace glovebench {

// Messages between glovebench and a tracker program (eval/guides/tracker.md).

inline constexpr int kTrackerProtocol = 1;
inline constexpr double kDepthUnit_mm = 0.1;

/// The first line: calibration, hand, angles.
std::string start_line(const RgbdCalibration& calibration, const HandModel& hand);
/// The line before a frame's images.
std::string frame_line(int number, const DeviceFrame& frame);
/// z in units of kDepthUnit_mm; 0: no value, or too far for 16 bits.
std::vector<uint16_t> depth_units(const DeviceFrame& frame, const OptionalLine& line);

/// The answer to frame `number`, without time stamp.
/// Throws: Error if it is none.
TrackResult parse_answer(std::string_view line, int number);

}  // namespace glovebench
