#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

/// A distant lamp and ambient light of one color.
struct Lighting {
  Eigen::Vector3d direction_to_light = {-0.3, -0.4, -0.87};  ///< camera frame, length > 0
  double strength = 1.0;        ///< > 0; at 1 a surface that faces the lamp emits its albedo
  double temperature_k = 5000;  ///< 2000..10000; the camera is balanced for 5000 K
  double ambient_share = 0.35;  ///< of the strength, [0, 1]

  /// One line per problem.
  std::vector<std::string> problems() const;
  friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// Linear sRGB of black-body light, luminance 1, balanced for 5000 K (Kim et al.'s spline).
Eigen::Vector3d rgb_of_temperature(double temperature_k);

/// Linear 0..1 to sRGB-coded 0..1.
double srgb_encode(double linear);

/// Applies gains > 0 to linear RGB. Clips at white.
ColorImage with_white_balance(const ColorImage& color, const Eigen::Vector3d& gains);

}  // namespace glovebench::render
