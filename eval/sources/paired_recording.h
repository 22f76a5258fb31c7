#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/kinect/device.h"
#include "core/kinect/frame_pairer.h"
#include "eval/sources/source.h"

namespace glovebench::eval {

struct RecordedImages {
  std::vector<int64_t> depth_us, color_us;        ///< from 0 to 1e16
  std::function<DepthImage(size_t index)> depth;  ///< Throws: Error
  std::function<ColorImage(size_t index)> color;  ///< Throws: Error
};

/// Plays a recording of metric depth, paired by FramePairer.
/// Throws: Error if there is no pair.
TrackSource paired_source(const std::string& where, const RgbdCalibration& calibration, RecordedImages images,
                          int64_t max_gap_us);

/// Two cameras like the RGB camera, for depth that is registered to color.
RgbdCalibration registered_to_color(const RgbdCalibration& calibration);

/// m; 0: no value.
DepthImage depth_in_m(const Image<uint16_t>& steps, double steps_per_m);

}  // namespace glovebench::eval
