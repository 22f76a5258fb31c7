#include "render/lighting.h"

#include <algorithm>
#include <cmath>

namespace glovebench::render {
namespace {

Eigen::Vector3d planckian_rgb(double kelvin) {
  const double t = 1000.0 / kelvin;
  const double x = kelvin < 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                 : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  const double y = kelvin < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                   : kelvin < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                   : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  Eigen::Matrix3d rgb_from_xyz;
  rgb_from_xyz << 3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434, -0.2040259,
      1.0572252;
  return rgb_from_xyz * Eigen::Vector3d(x / y, 1, (1 - x - y) / y);
}

/// The inverse of srgb_encode.
double srgb_decode(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

}  // namespace

std::vector<std::string> Lighting::problems() const {
  std::vector<std::string> found;
  if (!(direction_to_light.norm() > 0)) found.emplace_back("direction_to_light must not be zero");
  if (!(strength > 0)) found.emplace_back("strength must be > 0");
  if (!(temperature_k >= 2000 && temperature_k <= 10000))
    found.emplace_back("temperature_k must be in 2000..10000");
  if (!(ambient_share >= 0 && ambient_share <= 1)) found.emplace_back("ambient_share must be in [0, 1]");
  return found;
}

Eigen::Vector3d rgb_of_temperature(double temperature_k) {
  static const Eigen::Vector3d white = planckian_rgb(5000);
  const Eigen::Vector3d rgb = planckian_rgb(temperature_k).cwiseQuotient(white);
  return rgb / rgb.dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722));
}

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

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
