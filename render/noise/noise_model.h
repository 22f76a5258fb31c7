#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "render/color_noise.h"

namespace glovebench::render {

/// The gain of the `gradient` model, m px: variance = kGradientGain * |grad z|. It is set by one condition and
/// not tuned: on a plane that slants by 45 degrees, 0.7 m in front of the camera on its axis, the standard
/// deviation is 1.4 mm (Nguyen et al. 2012: 0.0012 + 0.0019 (z - 0.4)^2). There |grad z| = z / f = 0.7 m / 575.816
/// px.
inline constexpr double kGradientGain = 0.0014 * 0.0014 / (0.7 / 575.816);

/// The `kinect` model.
struct KinectNoiseConfig {
  double lateral_sigma_px = 0.5;  ///< of the pixel that a value is taken from (Handa et al. 2014), px, >= 0
  /// Before quantization, in steps of 1/8 px. With the rounding's 1/12 step^2 this makes the axial deviation that
  /// Khoshelham and Elberink 2012 measured, 1.425e-6 z^2 mm = 0.49 steps. >= 0
  double disparity_sigma_steps = 0.40;
  double grazing_from_deg = 70.0;     ///< incidence from which values drop out now and then, [0, 90)
  double grazing_to_deg = 85.0;       ///< incidence from which every value drops out, (grazing_from_deg, 90]
  double min_depth = 0.45;            ///< nearer surfaces give no value, m, >= 0
  double projector_baseline = 0.075;  ///< the projector stands this far along the IR camera's +x, m; 0: no shadow
};

struct NoiseConfig {
  std::string depth = "gradient";  ///< name of a DepthNoise
  double gain_factor = 1.0;  ///< multiplies kGradientGain, that is the variance; 0.5 and 2 are reported too, >= 0
  double color_sigma_gray = kColorSigma_gray;  ///< of each 8-bit channel, gray levels, >= 0
  KinectNoiseConfig kinect;

  /// All problems, one per line; empty if there are none.
  std::vector<std::string> problems() const;
};

/// How the depth camera errs, before the 11-bit quantization that always follows. A model is one file:
/// render/noise/X_noise.cpp defines `DepthNoise X_noise()`.
struct DepthNoise {
  std::string_view name;         ///< X
  std::string_view description;  ///< one line
  /// The depth as the noisy sensor would measure it with unlimited resolution (m, 0 = no value). Pixels without a
  /// value stay without. All random numbers come from `key`.
  DepthImage (*add)(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                    const FrameKey& key);
};
/// Sorted by name.
std::span<const DepthNoise> depth_noises();
/// Throws Error listing the known ones.
const DepthNoise& find_depth_noise(std::string_view name);

/// By the model that the configuration names. Throws Error for an unknown one.
DepthImage add_depth_noise(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                           const FrameKey& key);

}  // namespace glovebench::render
