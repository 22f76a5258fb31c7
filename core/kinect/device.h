#pragma once

#include <cstdint>
#include <optional>

#include "core/base/error.h"
#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

struct DeviceFrame {
  Image<uint16_t> raw_disparity;  ///< 640x480, 11 bits, 2047: no value
  ColorImage color;               ///< 640x480, not registered
  int64_t depth_timestamp_us = 0;
  int64_t color_timestamp_us = 0;
};

class FrameError : public Error {
 public:
  using Error::Error;
};

/// A source of frames. Their depth and color are paired by time.
class Device {
 public:
  virtual ~Device() = default;
  virtual const RgbdCalibration& calibration() const = 0;
  /// Empty at the end.
  /// Throws: FrameError if only this frame is unusable, another Error if the device fails.
  virtual std::optional<DeviceFrame> next_frame() = 0;
};

}  // namespace glovebench
