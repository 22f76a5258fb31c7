#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/kinect/device.h"

namespace glovebench {

struct FreenectOptions {
  int index = 0;  ///< of the devices that libfreenect finds
  /// Lets the device wait when frames are not fetched in time, instead of dropping the oldest: for what fakenect
  /// plays. A Kinect does not wait; it loses packets.
  bool every_frame = false;
  double silence_limit = 10;                     ///< s without a frame after which the device has failed
  std::string calibration_name = "calibration";  ///< in messages: its file
  std::function<bool()> interrupted;  ///< asked ten times a second while nothing arrives; true ends the stream
};

/// What became of the images that are in no frame.
struct FreenectLosses {
  int late = 0;       ///< whole frames that were not fetched in time, since the first was asked for
  int unpaired = 0;   ///< depth images with no color image near them
  int went_back = 0;  ///< images whose time stamp was not later than that of the one before

  int total() const { return late + unpaired + went_back; }
};

/// A Kinect v1 through libfreenect's asynchronous interface: 11-bit disparity and RGB, 640x480, paired as
/// FramePairer does, so a frame comes up to one color image (33 ms) after its depth image. Which library is behind
/// the interface is decided when the program is loaded: the real one, or fakenect, which plays a recording.
///
/// A thread of its own takes what the device gives; a frame that is not fetched until the next two have come is
/// dropped and counted. Time stamps are the device's, in microseconds, and do not come around.
class FreenectDevice : public Device {
 public:
  /// Opens the device and starts both streams. Throws Error if there is none or it refuses, or the calibration is
  /// of other images than 640x480; where the environment names a dump for fakenect (FAKENECT_PATH), also if that
  /// dump is damaged, as fakenect would end the program.
  explicit FreenectDevice(const RgbdCalibration& calibration, FreenectOptions options = {});
  /// Waits until the library gives control back: fakenect, only after a pause in its recording.
  ~FreenectDevice() override;

  const RgbdCalibration& calibration() const override;
  /// Waits for the next frame. Nothing at the end of what fakenect plays (with FAKENECT_PATH set) or on
  /// `interrupted`. Throws Error when the device has failed, once the frames that came before are fetched: it was
  /// unplugged, gave nothing for `silence_limit`, or there was no memory.
  std::optional<DeviceFrame> next_frame() override;

  /// When the frame that was fetched last was whole, microseconds since 1970 by the system's clock; 0 before the
  /// first.
  int64_t arrived_us() const;

  FreenectLosses losses() const;
  /// Why the stream has ended; empty while it has not, and if the device has failed.
  std::string end() const;

 private:
  class Stream;
  RgbdCalibration calibration_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace glovebench
