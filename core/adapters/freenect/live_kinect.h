#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/kinect/device.h"

namespace glovebench {

struct LiveOptions {
  int index = 0;  ///< of the devices that libfreenect finds
  /// Lets the device wait when frames are not fetched in time, instead of dropping the oldest: for what fakenect
  /// plays. A Kinect does not wait; it loses packets.
  bool every_frame = false;
  double silence_limit = 10;                     ///< s without a frame after which the device has failed
  std::string calibration_name = "calibration";  ///< in messages: its file
  std::function<bool()> interrupted;  ///< asked ten times a second while nothing arrives; true ends the stream
};

/// Counts of the images that are in no frame.
struct LiveLosses {
  int late = 0;       ///< whole frames that were not fetched in time, since the first was asked for
  int unpaired = 0;   ///< depth images with no color image near them
  int went_back = 0;  ///< images whose time stamp was not later than that of the one before

  int total() const { return late + unpaired + went_back; }
};

/// A Kinect v1 that is plugged in: 11-bit disparity and RGB, 640x480, paired as FramePairer does, so a frame comes
/// up to one color image (33 ms) after its depth image. A frame that is not fetched until the next two have come is
/// dropped and counted. Time stamps are the device's, in microseconds, and do not come around.
///
/// `next_frame` has nothing at the end of what fakenect plays and on `interrupted`. It throws Error when the device
/// has failed, once the frames that came before are fetched: it was unplugged, gave nothing for `silence_limit`, or
/// there was no memory.
class LiveKinect : public Device {
 public:
  /// When the frame that was fetched last was whole, microseconds since 1970 by the system's clock; 0 before the
  /// first.
  virtual int64_t arrived_us() const = 0;
  virtual LiveLosses losses() const = 0;
  /// Why the stream has ended; empty while it has not, and if the device has failed.
  virtual std::string end() const = 0;
};

/// Whether this build has libfreenect.
extern const bool kHasFreenect;

/// Starts both streams through libfreenect's asynchronous interface. Which library is behind it is decided when the
/// program is loaded: the real one, or fakenect, which plays a recording. A thread of its own takes what the device
/// gives; to end it takes until the library gives control back: with fakenect, only after a pause in its recording.
/// Throws Error if there is no device or it refuses, the calibration is of other images than 640x480, or this build
/// has no libfreenect; where the environment names a dump for fakenect (FAKENECT_PATH), also if that dump is
/// damaged, as fakenect would end the program.
std::unique_ptr<LiveKinect> open_kinect(const RgbdCalibration& calibration, const LiveOptions& options = {});

}  // namespace glovebench
