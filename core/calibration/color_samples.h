#pragma once

#include <cstdint>
#include <vector>

#include "core/camera/registration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/kinect/device.h"

namespace glovebench::calibration {

struct SampleConfig {
  WorkingVolume volume;  ///< where the hand is
  RegistrationConfig registration;
  double surface_step = 0.02;  ///< neighbors that differ more in depth lie on different surfaces, m, > 0
  int beyond_stride = 16;      ///< of the pixels beyond the volume, every nth is kept, >= 1
};

/// A pixel's color, and in which frame it was.
struct ColorSample {
  Rgb rgb{};
  uint16_t frame = 0;  ///< number among those added
};

/// A pixel between two even ones, and those: where two patches meet, or the hand ends, one pixel mixes two colors.
struct MixedSample {
  Rgb rgb{};
  Rgb near{};   ///< of the even pixel nearest to it, in the volume
  Rgb other{};  ///< of the one within reach that differs most from that, in the volume or beyond
  bool other_is_inside = false;
};

/// A frame as the IR camera's pixels: its color, and 1 where there is one and the depth lies in the volume.
struct VolumeView {
  ColorImage color;
  Image<uint8_t> inside;
};
VolumeView view_volume(const DeviceFrame& frame, const RgbdCalibration& calibration, const SampleConfig& config);

/// Pixels of a recording without labels: even ones, which look like their four neighbors on the same surface, and
/// what lies between two of them.
class ColorSamples {
 public:
  explicit ColorSamples(SampleConfig config = {}) : config_(config) {}

  void add_frame(const DeviceFrame& frame, const RgbdCalibration& calibration);

  const SampleConfig& config() const { return config_; }
  int frames() const { return frames_; }
  const std::vector<ColorSample>& inside() const { return inside_; }
  /// Farther than the volume, by more than a hand that is cut off by it reaches (kCutOffMargin).
  const std::vector<ColorSample>& beyond() const { return beyond_; }
  const std::vector<MixedSample>& mixed() const { return mixed_; }
  /// All pixels with a color in the volume, even or not.
  int64_t inside_pixels() const { return inside_pixels_; }
  /// Camera noise, the standard deviation of the green channel: the median over the frames that show anything in
  /// the volume; 0 if none does.
  double noise_gray() const;

 private:
  SampleConfig config_;
  int frames_ = 0;
  int64_t inside_pixels_ = 0;
  int64_t beyond_pixels_ = 0;
  std::vector<ColorSample> inside_, beyond_;
  std::vector<MixedSample> mixed_;
  std::vector<double> noise_;  ///< of each frame with something in the volume
};

}  // namespace glovebench::calibration
