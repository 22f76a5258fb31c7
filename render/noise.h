#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"
#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench::render {

/// How the depth camera errs, before the 11-bit quantization that always follows.
enum class DepthNoise {
  none,
  gradient,  ///< section IV: Gaussian, variance scaled with the gradient magnitude image
  kinect,    ///< in the disparity domain: lateral shift, disparity noise, dropouts, projector shadow
};
constexpr auto names_of(DepthNoise) {
  return std::to_array<std::string_view>({"none", "gradient", "kinect"});
}
/// Throws Error for a name that is none.
DepthNoise depth_noise_from_string(std::string_view name);

/// The gain of `DepthNoise::gradient`, m px: variance = kGradientGain * |grad z|. It is set by one condition and
/// not tuned: on a plane that slants by 45 degrees, 0.7 m in front of the camera on its axis, the standard
/// deviation is 1.4 mm (Nguyen et al. 2012: 0.0012 + 0.0019 (z - 0.4)^2). There |grad z| = z / f = 0.7 m / 575.816
/// px.
inline constexpr double kGradientGain = 0.0014 * 0.0014 / (0.7 / 575.816);

struct NoiseConfig {
  DepthNoise depth = DepthNoise::gradient;
  double gain_factor = 1.0;  ///< multiplies kGradientGain, that is the variance; 0.5 and 2 are reported too, >= 0
  double color_sigma_gray = 2.0;  ///< of each 8-bit channel, gray levels, >= 0

  // The `kinect` model.
  double lateral_sigma_px = 0.5;  ///< of the pixel that a value is taken from (Handa et al. 2014), px, >= 0
  /// Before quantization, in steps of 1/8 px. With the rounding's 1/12 step^2 this makes the axial deviation that
  /// Khoshelham and Elberink 2012 measured, 1.425e-6 z^2 mm = 0.49 steps. >= 0
  double disparity_sigma_steps = 0.40;
  double grazing_from_deg = 70.0;     ///< incidence from which values drop out now and then, [0, 90)
  double grazing_to_deg = 85.0;       ///< incidence from which every value drops out, (grazing_from_deg, 90]
  double min_depth = 0.45;            ///< nearer surfaces give no value, m, >= 0
  double projector_baseline = 0.075;  ///< the projector stands this far along the IR camera's +x, m; 0: no shadow

  /// All problems, one per line; empty if there are none.
  std::vector<std::string> problems() const;
};

/// Names the random numbers of one frame; neither thread nor order changes them.
struct FrameKey {
  uint64_t seed = 0;
  std::string_view sequence;
  int64_t frame = 0;
};

/// |grad z| in metres per pixel: central differences (z(u+1) - z(u-1)) / 2 in u and v and their Euclidean norm.
/// Where one of the two neighbors has no value or lies outside the image, the one-sided difference to the other;
/// where both are missing, 0. Pixels without a value (z = 0) have gradient 0.
Image<float> gradient_magnitude(const DepthImage& depth);

/// The depth as the noisy sensor would measure it with unlimited resolution (metres, 0 = no value). Pixels without
/// a value stay without; `gradient` never removes one unless its value would not be positive.
DepthImage add_depth_noise(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                           const FrameKey& key);

/// Adds Gaussian noise to each channel, rounded and clamped to 0..255.
ColorImage add_color_noise(const ColorImage& color, const NoiseConfig& config, const FrameKey& key);

}  // namespace glovebench::render
