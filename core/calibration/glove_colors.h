#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/calibration/color_samples.h"
#include "core/calibration/color_seeds.h"
#include "core/segmentation/color_calibration.h"

namespace glovebench::calibration {

/// Little change of light: a recording shows its own.
ColorModel recorded_color_model();

struct GloveColorConfig {
  double min_luma = 16;                       ///< darker: unsure; 0..255
  double glove_distance = 3.5;                ///< standard deviations; nearer pixels have the color, > 0
  double other_distance = 6.0;                ///< farther pixels do not; unsure between both
  int64_t min_pixels = 200;                   ///< fewest even pixels of a color
  int64_t few_pixels = 2000;                  ///< fewer cause a warning
  int few_frames = 3;                         ///< fewer cause a warning
  bool mixed_pixels = true;                   ///< label mixed pixels by their larger part
  ColorModel model = recorded_color_model();  ///< `not_glove_prior` is measured
};

/// A color as a Gaussian in the chroma plane.
struct GloveColor {
  Chroma seed = Chroma::Zero();  ///< in the recording's light
  Chroma center = Chroma::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< without camera noise
  double reach = 0;                                      ///< largest distance of `center` from `seed`
  std::array<double, 5> lumas{};                         ///< 10, 30, 50, 70, 90% quantiles of Y
  double weight = 0;                                     ///< share of the volume's even pixels
  int64_t pixels = 0;                                    ///< even ones
  int frames = 0;
};

inline constexpr uint8_t kNotGlove = 0, kUnsure = 255;

struct GloveColorFit {
  RecordedLight light;
  double noise_gray = 0;
  GloveColorConfig config;
  std::array<GloveColor, kColorCount + 1> colors;
  std::vector<GloveColor> others;             ///< other frequent colors, such as skin
  int64_t glove = 0, other = 0, unsure = 0;   ///< even pixels in the volume
  int64_t beyond = 0, beyond_like_glove = 0;  ///< pixels behind the volume
  std::array<int64_t, kColorCount + 1> beyond_like{};

  /// The most probable color within `glove_distance`, else kNotGlove or kUnsure. Dark pixels are kUnsure.
  uint8_t classify(const Rgb& rgb) const;
};

/// Expectation maximization for light, glove colors and other frequent ones. Each center stays nearest to its own
/// seed.
/// Throws: Error if frames, hand or colors are missing.
GloveColorFit fit_glove_colors(const ColorSamples& samples, const ColorSeeds& seeds, const std::string& where,
                               const GloveColorConfig& config = {});

/// Uses classified pixels, without clutter of glove color behind the volume.
ColorTable build_color_table(const ColorSamples& samples, const GloveColorFit& fit,
                             ColorSpace space = ColorSpace::yuv);

}  // namespace glovebench::calibration
