#pragma once

#include <span>

#include "core/calibration/color_samples.h"
#include "core/calibration/color_seeds.h"

namespace glovebench::calibration {

/// What the light and the camera of a recording do to the seeds' colors.
struct RecordedLight {
  Eigen::Array3d gain = Eigen::Array3d::Ones();  ///< of light and white balance on linear R, G, B, with G = 1
  /// Factor on the chroma: above 1 in weak light, where the foot of the coding's curve takes the dark channels
  /// further down, and of a camera that saturates; below 1 where haze or reflections add white.
  double saturation = 1;
};

/// The seeds as they look under another light: gains on gamma-coded RGB (exponent 1 / 2.2).
ColorSeeds relit(const ColorSeeds& seeds, const RecordedLight& light);

/// The light under which the recording shows most of the ten colors: the sum over the colors of the logarithm of
/// the density of samples around where the light puts them, by search over the gains of red (0.4 to 2.5) and blue
/// (0.18 to 5.5) and the saturation (0.8 to 1.25). A color that is not there costs what it costs under every light;
/// a color that covers much of the hand counts no more than one that covers little. Without samples: the seeds'
/// own.
RecordedLight estimate_light(const ColorSeeds& seeds, std::span<const ColorSample> samples, double min_luma);

}  // namespace glovebench::calibration
