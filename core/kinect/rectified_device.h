#pragma once

#include <memory>

#include "core/kinect/device.h"
#include "core/kinect/rectification.h"

namespace glovebench {

/// A device as it would be with pinholes for lenses: frames are rectified, and its calibration says so. This is
/// what a tracker needs of a device whose calibration knows its lenses.
class RectifiedDevice : public Device {
 public:
  /// Throws Error if the lenses cannot be undone.
  explicit RectifiedDevice(std::unique_ptr<Device> device);

  const RgbdCalibration& calibration() const override { return calibration_; }
  std::optional<DeviceFrame> next_frame() override;

 private:
  std::unique_ptr<Device> device_;
  RgbdCalibration calibration_;
  std::optional<Rectification> ir_, rgb_;  ///< made with the first frame
};

/// The device, rectified if its calibration knows a lens.
std::unique_ptr<Device> without_lens_distortion(std::unique_ptr<Device> device);

}  // namespace glovebench
