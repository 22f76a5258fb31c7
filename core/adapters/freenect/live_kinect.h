#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/kinect/device.h"

namespace glovebench {

struct LiveOptions {
  int index = 0;  ///< among the devices that libfreenect finds
  /// Makes fakenect wait for a slow reader instead of dropping frames. A real Kinect would lose packets.
  bool every_frame = false;
  double silence_limit = 10;                     ///< s without a frame, after which the device has failed
  std::string calibration_name = "calibration";  ///< its file, for messages
  std::function<bool()> interrupted;  ///< asked 10 times a second while nothing arrives; true ends the stream
};

/// Counts of images that are in no frame.
struct LiveLosses {
  int late = 0;       ///< frames that were not fetched in time, after the first call of `next_frame`
  int unpaired = 0;   ///< depth images without a color image near in time
  int went_back = 0;  ///< images whose time stamp was not later than the last

  int total() const { return late + unpaired + went_back; }
};

/// A live Kinect v1: 11-bit disparity and RGB, 640x480, paired by FramePairer up to 33 ms after the depth image. A
/// frame is dropped if it is not fetched before the next two. Time stamps are the device's, in us, and do not wrap
/// around.
///
/// `next_frame` returns nothing at the end of fakenect's recording and when `interrupted`.
/// Throws: Error, after the earlier frames, if the device was unplugged, was silent for `silence_limit`, or memory
/// ran out.
class LiveKinect : public Device {
 public:
  /// When the last fetched frame was complete, microseconds since 1970; 0 before the first.
  virtual int64_t arrived_us() const = 0;
  virtual LiveLosses losses() const = 0;
  /// Why the stream ended; empty before that or if the device failed.
  virtual std::string end() const = 0;
};

extern const bool kHasFreenect;

/// Starts both streams. Whether the real libfreenect answers or fakenect, which plays a recording, is decided when
/// the program is loaded. A thread serves the device; it ends only when the library returns, with fakenect at a
/// pause of the recording.
/// Throws: Error if the device is missing or refuses, the calibration is not of 640x480, this build has no
/// libfreenect, or the recording in FAKENECT_PATH is damaged, at which fakenect would end the program.
std::unique_ptr<LiveKinect> open_kinect(const RgbdCalibration& calibration, const LiveOptions& options = {});

}  // namespace glovebench
