#pragma once

#include <cstdint>
#include <optional>

#include "core/base/error.h"
#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

/// Images of the calibration's sizes. Either `raw_disparity` or `depth` is empty.
struct DeviceFrame {
  Image<uint16_t> raw_disparity;  ///< 11 bits, 2047: no value
  ColorImage color = {};          ///< not registered
  int64_t depth_timestamp_us = 0;
  int64_t color_timestamp_us = 0;
  DepthImage depth = {};  ///< if the device measures depth, m
};

class FrameError : public Error {
 public:
  using Error::Error;
};

/// Frames of depth and color paired by time.
class Device {
 public:
  virtual ~Device() = default;
  virtual const RgbdCalibration& calibration() const = 0;
  /// Empty at the end.
  /// Throws: FrameError if only this frame is unusable, another Error if the device fails.
  virtual std::optional<DeviceFrame> next_frame() = 0;
};

}  // namespace glovebench
