#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "core/kinect/device.h"

namespace glovebench {

/// Throws Error if a lens cannot be undone within the image: it puts what lies farther out nearer to the center.
void require_unfolded(const PinholeCamera& camera, const LensDistortion& lens);

/// Takes the distortion of a lens out of a camera's images: what the same camera with a pinhole would have given.
/// Pixels that lie outside of the image get nothing.
class Rectification {
 public:
  /// Throws Error like require_unfolded.
  Rectification(const PinholeCamera& camera, const LensDistortion& lens);

  /// Disparity, pixel by pixel: values of two surfaces are never mixed. Nothing is 2047. Like the next, of an image
  /// of the camera's size.
  Image<uint16_t> operator()(const Image<uint16_t>& raw_disparity) const;
  /// Color, between pixels (bilinear). Nothing is black.
  ColorImage operator()(const ColorImage& color) const;

 private:
  using Place = std::array<int16_t, 2>;  ///< u, v in the distorted image

  Image<Place> nearest_;
  Image<Place> top_left_;      ///< of the four pixels around
  Image<uint16_t> fractions_;  ///< OpenCV's index of the weights of the four
};

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
