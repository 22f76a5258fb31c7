#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/calibration/color_samples.h"
#include "core/calibration/color_seeds.h"
#include "core/calibration/recorded_light.h"
#include "core/segmentation/color_calibration.h"

namespace glovebench::calibration {

/// How the table of a recording is built: it has seen the light that it is for, so it relights less than one that
/// must do for any; the share that is not glove is the recording's own.
ColorModel recorded_color_model();

struct GloveColorConfig {
  double min_luma = 16;         ///< darker pixels tell no color, 0..255
  double glove_distance = 3.5;  ///< within so many deviations of a color a pixel is that color, > 0
  double other_distance = 6.0;  ///< beyond so many of every color it is no glove; between the two it is left out
  int64_t min_pixels = 200;     ///< even pixels of a color in the whole recording; fewer: it was not seen
  int64_t few_pixels = 2000;    ///< fewer: a warning
  int few_frames = 3;           ///< fewer: a warning
  bool mixed_pixels = true;     ///< pixels between two colors get the label of the one that they hold more of
  ColorModel model = recorded_color_model();  ///< but for `not_glove_prior`, which is measured
};

/// A color of the glove as a recording shows it.
struct GloveColor {
  Chroma seed = Chroma::Zero();                          ///< where the seed lies under the recording's light
  Chroma center = Chroma::Zero();                        ///< where the recording's pixels lie
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of their chroma, without camera noise
  double reach = 0;                                      ///< how far the center might have gone from the seed
  std::array<double, 5> lumas{};                         ///< Y that 10, 30, 50, 70 and 90% of its pixels lie below
  double weight = 0;                                     ///< share of the even pixels in the volume
  int64_t pixels = 0;                                    ///< even ones that are this color
  int frames = 0;                                        ///< that show it
};

/// What a pixel's color says by the fitted models: a label, or one of these.
inline constexpr uint8_t kNotGlove = 0, kUnsure = 255;

/// The ten colors of a recording. Index 0 of `colors` is unused.
struct GloveColorFit {
  RecordedLight light;    ///< what brought the seeds to the recording
  double noise_gray = 0;  ///< camera noise
  GloveColorConfig config;
  std::array<GloveColor, kColorCount + 1> colors;
  std::vector<GloveColor> others;             ///< what else the volume shows much of, such as skin
  int64_t glove = 0, other = 0, unsure = 0;   ///< even pixels in the volume, by what they are
  int64_t beyond = 0, beyond_like_glove = 0;  ///< pixels beyond the volume; of those, clutter in the glove's colors
  std::array<int64_t, kColorCount + 1> beyond_like{};  ///< the same by color

  /// The color of a pixel: the most probable one, others included, if it lies within `glove_distance` of it.
  /// Dark pixels are unsure, and overexposed ones that are no color of the glove.
  uint8_t classify(const Rgb& rgb) const;
};

/// Finds the glove's colors in a recording: the light by all seeds together, then a bell in the chroma plane for
/// each color, and for what else there is much of, by expectation maximization with an even density for the rest; a
/// bell stays nearer to its own seed than to another's. Throws Error naming `where`: a recording without frames,
/// with nothing in the volume, with no glove in view, or the colors that were not seen.
GloveColorFit fit_glove_colors(const ColorSamples& samples, const ColorSeeds& seeds, const std::string& where,
                               const GloveColorConfig& config = {});

/// The table of the fitted colors: their pixels labeled, everything else in the volume and beyond it as not glove
/// (but clutter in the glove's colors beyond it, which no label image reaches), through the Bayes and relighting
/// builder of ColorCalibration.
ColorTable build_color_table(const ColorSamples& samples, const GloveColorFit& fit,
                             ColorSpace space = ColorSpace::yuv);

}  // namespace glovebench::calibration
