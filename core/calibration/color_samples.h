#pragma once

#include <cstdint>
#include <vector>

#include "core/camera/registration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/kinect/device.h"

namespace glovebench::calibration {

struct SampleConfig {
  WorkingVolume volume;
  RegistrationConfig registration;
  double surface_step = 0.02;  ///< depth step, m, > 0
  int beyond_stride = 16;      ///< keep every nth pixel, >= 1
};

struct ColorSample {
  Rgb rgb{};
  uint16_t frame = 0;
};

/// A pixel that mixes two colors, between even pixels of both.
struct MixedSample {
  Rgb rgb{};
  Rgb near{};   ///< nearest even pixel, in the volume
  Rgb other{};  ///< even pixel within 3 px, least like `near`
  bool other_is_inside = false;
};

/// IR pixels. `inside`: 1 for a colored pixel in the volume.
struct VolumeView {
  ColorImage color;
  Image<uint8_t> inside;
};
VolumeView view_volume(const DeviceFrame& frame, const RgbdCalibration& calibration, const SampleConfig& config);

/// Pixels of an unlabeled recording. Even pixels share surface and color with their four neighbors.
class ColorSamples {
 public:
  explicit ColorSamples(SampleConfig config = {}) : config_(config) {}

  void add_frame(const DeviceFrame& frame, const RgbdCalibration& calibration);

  const SampleConfig& config() const { return config_; }
  int frames() const { return frames_; }
  const std::vector<ColorSample>& inside() const { return inside_; }
  /// Even pixels more than kCutOffMargin behind the volume.
  const std::vector<ColorSample>& beyond() const { return beyond_; }
  const std::vector<MixedSample>& mixed() const { return mixed_; }
  int64_t inside_pixels() const { return inside_pixels_; }
  /// Deviation of green noise, 0..255; 0 without pixels in the volume.
  double noise_gray() const;

 private:
  SampleConfig config_;
  int frames_ = 0;
  int64_t inside_pixels_ = 0;
  int64_t beyond_pixels_ = 0;
  std::vector<ColorSample> inside_, beyond_;
  std::vector<MixedSample> mixed_;
  std::vector<double> noise_;
};

}  // namespace glovebench::calibration
