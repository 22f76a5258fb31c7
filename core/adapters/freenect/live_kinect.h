#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/kinect/device.h"

namespace glovebench {

struct LiveOptions {
  int index = 0;  ///< of the device in libfreenect
  /// fakenect waits for slow readers; a Kinect never does.
  bool every_frame = false;
  double silence_limit = 10;                     ///< s without a frame; then the device has failed
  std::string calibration_name = "calibration";  ///< for messages
  std::function<bool()> interrupted;             ///< polled at 10 Hz; true ends
};

struct LiveLosses {
  int late = 0;       ///< dropped before it was fetched; counted after the first `next_frame`
  int unpaired = 0;   ///< depth images without near color image
  int went_back = 0;  ///< not later than the image before

  int total() const { return late + unpaired + went_back; }
};

/// A live Kinect v1, 640x480. A frame comes up to 33 ms after its depth image (FramePairer). Two frames may wait;
/// older ones are dropped. `next_frame` is empty at the end of fakenect's recording and when `interrupted`.
/// Throws: Error, after earlier frames, if the device is unplugged, silent for `silence_limit`, or memory runs
/// out.
class LiveKinect : public Device {
 public:
  /// When the last fetched frame was complete, us since 1970. 0: none.
  virtual int64_t arrived_us() const = 0;
  virtual LiveLosses losses() const = 0;
  /// Why the stream ended. Empty before, and after a failure.
  virtual std::string end() const = 0;
};

extern const bool kHasFreenect;

/// Starts the device and a thread. fakenect, loaded in place of libfreenect, plays a recording.
/// Throws: Error if the device is missing or refuses, the calibration is not 640x480, this build lacks
/// libfreenect, or fakenect's recording (FAKENECT_PATH) is damaged.
std::unique_ptr<LiveKinect> open_kinect(const RgbdCalibration& calibration, const LiveOptions& options = {});

}  // namespace glovebench
