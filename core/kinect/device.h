#pragma once

#include <cstdint>
#include <optional>

#include "core/base/error.h"
#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

/// What one Kinect v1 gives for one moment, and all that the tracker sees.
struct DeviceFrame {
  Image<uint16_t> raw_disparity;  ///< 640x480, 11 bits, 2047 = no value (see disparity.h)
  ColorImage color;               ///< 640x480, from the RGB camera, not registered
  int64_t depth_timestamp_us = 0;
  int64_t color_timestamp_us = 0;
};

/// One frame is unusable; the stream goes on.
class FrameError : public Error {
 public:
  using Error::Error;
};

/// A source of frames: the synthetic Kinect, a recording, or a live device. A live implementation pairs
/// depth and color by time stamp itself and hands out whole frames only.
class Device {
 public:
  virtual ~Device() = default;
  virtual const RgbdCalibration& calibration() const = 0;
  /// The next frame in time, or nothing at the end of the stream. Throws FrameError if that frame is unusable (the
  /// next call goes on with the one after it) and any other Error if the device fails.
  virtual std::optional<DeviceFrame> next_frame() = 0;
};

}  // namespace glovebench
