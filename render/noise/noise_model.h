#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "render/color_noise.h"

namespace glovebench::render {

/// Variance per |grad z| of `gradient`, m px: standard deviation 1.4 mm at 45 degrees and 0.7 m (Nguyen et al.
/// 2012). Not tuned.
inline constexpr double kGradientGain = 0.0014 * 0.0014 / (0.7 / 575.816);

struct KinectNoiseConfig {
  double lateral_sigma_px = 0.5;  ///< of the sampled position (Handa et al. 2014), >= 0
  /// 1/8 px, before quantization, >= 0; quantized: axial deviation of Khoshelham and Elberink 2012
  double disparity_sigma_steps = 0.40;
  double grazing_from_deg = 70.0;     ///< incidence where dropouts begin, [0, 90)
  double grazing_to_deg = 85.0;       ///< incidence where all drop out, (grazing_from_deg, 90]
  double min_depth = 0.45;            ///< m, >= 0
  double projector_baseline = 0.075;  ///< along the IR camera's +x, m; 0: no shadow
};

struct NoiseConfig {
  std::string depth = "gradient";              ///< name of a DepthNoise
  double gain_factor = 1.0;                    ///< of the variance of `gradient`, >= 0
  double color_sigma_gray = kColorSigma_gray;  ///< per 8-bit channel, >= 0
  KinectNoiseConfig kinect;

  /// One line per problem.
  std::vector<std::string> problems() const;
};

/// Depth errors before 11-bit quantization. render/noise/X_noise.cpp defines `DepthNoise X_noise()`.
struct DepthNoise {
  std::string_view name;
  std::string_view description;
  /// `depth`: unlimited resolution, m. Missing values (0) stay missing. `key` seeds all random numbers.
  DepthImage (*add)(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                    const FrameKey& key);
};
std::span<const DepthNoise> depth_noises();
/// Throws: Error.
const DepthNoise& find_depth_noise(std::string_view name);

/// Throws: Error.
DepthImage add_depth_noise(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                           const FrameKey& key);

}  // namespace glovebench::render
