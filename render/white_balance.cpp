#include "render/white_balance.h"

#include <algorithm>
#include <cmath>

#include "render/lighting.h"

namespace glovebench::render {
namespace {

/// The inverse of srgb_encode.
double srgb_decode(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

}  // namespace

ColorImage with_white_balance(const ColorImage& color, const Eigen::Vector3d& gains) {
  std::array<std::array<uint8_t, 256>, 3> table;
  for (int channel = 0; channel < 3; ++channel)
    for (int value = 0; value < 256; ++value) {
      const double coded = srgb_encode(std::min(1.0, gains[channel] * srgb_decode(value / 255.0)));
      table[channel][value] = static_cast<uint8_t>(std::lround(255 * coded));
    }
  ColorImage balanced = color;
  for (Rgb& rgb : balanced)
    for (int channel = 0; channel < 3; ++channel) rgb[channel] = table[channel][rgb[channel]];
  return balanced;
}

}  // namespace glovebench::render
