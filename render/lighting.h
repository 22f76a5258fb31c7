#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

/// One distant lamp and an even ambient light of the same color. No shadows are cast.
struct Lighting {
  Eigen::Vector3d direction_to_light = {-0.3, -0.4, -0.87};  ///< camera frame, any length > 0
  double strength = 1.0;        ///< at 1 a surface that faces the lamp sends out its albedo, > 0
  double temperature_k = 5000;  ///< of the light, kelvin, 2000..10000; the camera's white balance stays at 5000 K
  double ambient_share = 0.35;  ///< share of the strength that comes from everywhere, [0, 1]

  /// All problems, one per line; empty if there are none.
  std::vector<std::string> problems() const;
  friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// Linear RGB (sRGB primaries) of a black body's light, as seen by a camera that is balanced for 5000 K, at
/// luminance 1. The chromaticity is Kim et al.'s cubic spline of the Planckian locus.
Eigen::Vector3d rgb_of_temperature(double temperature_k);

/// The sRGB transfer function: linear 0..1 to coded 0..1.
double srgb_encode(double linear);

/// The image of a camera whose white balance has drifted: gains on linear R, G, B (> 0), coded again, cut off at
/// white.
ColorImage with_white_balance(const ColorImage& color, const Eigen::Vector3d& gains);

}  // namespace glovebench::render
