#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "core/kinect/device.h"

namespace glovebench {

/// Throws: Error if the distortion folds the image.
void require_unfolded(const PinholeCamera& camera, const LensDistortion& lens);

/// Undistorts images of the camera's size.
class Rectification {
 public:
  /// Throws: Error as `require_unfolded`.
  Rectification(const PinholeCamera& camera, const LensDistortion& lens);

  /// Takes the nearest pixel; 2047 outside.
  Image<uint16_t> operator()(const Image<uint16_t>& raw_disparity) const;
  /// Takes the nearest pixel; 0 outside.
  DepthImage operator()(const DepthImage& depth) const;
  /// Interpolates; black outside.
  ColorImage operator()(const ColorImage& color) const;

 private:
  using Place = std::array<int16_t, 2>;  ///< u, v in the distorted image

  Image<Place> nearest_;
  Image<Place> top_left_;      ///< of four neighbors
  Image<uint16_t> fractions_;  ///< OpenCV's index of their weights
};

class RectifiedDevice : public Device {
 public:
  /// Throws: Error as `require_unfolded`.
  explicit RectifiedDevice(std::unique_ptr<Device> device);

  const RgbdCalibration& calibration() const override { return calibration_; }
  std::optional<DeviceFrame> next_frame() override;

 private:
  std::unique_ptr<Device> device_;
  RgbdCalibration calibration_;
  std::optional<Rectification> ir_, rgb_;
};

/// Rectifies if the calibration has a lens.
std::unique_ptr<Device> without_lens_distortion(std::unique_ptr<Device> device);

}  // namespace glovebench
