#include "core/kinect/rectified_device.h"

namespace glovebench {

RectifiedDevice::RectifiedDevice(std::unique_ptr<Device> device)
    : device_(std::move(device)), calibration_(device_->calibration().rectified()) {
  require_unfolded(calibration_.ir, device_->calibration().ir_lens);
  require_unfolded(calibration_.rgb, device_->calibration().rgb_lens);
}

std::optional<DeviceFrame> RectifiedDevice::next_frame() {
  std::optional<DeviceFrame> frame = device_->next_frame();
  if (!frame) return frame;
  // Only now: the maps are as large as the images, which a calibration may claim without any.
  if (!ir_) ir_.emplace(calibration_.ir, device_->calibration().ir_lens);
  if (!rgb_) rgb_.emplace(calibration_.rgb, device_->calibration().rgb_lens);
  frame->raw_disparity = (*ir_)(frame->raw_disparity);
  frame->color = (*rgb_)(frame->color);
  return frame;
}

std::unique_ptr<Device> without_lens_distortion(std::unique_ptr<Device> device) {
  if (!device->calibration().has_lens()) return device;
  return std::make_unique<RectifiedDevice>(std::move(device));
}

}  // namespace glovebench
