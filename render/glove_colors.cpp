#include "render/glove_colors.h"

#include "render/lighting.h"

namespace glovebench::render {
namespace {

using Albedos = std::array<Eigen::Vector3f, kColorCount + 1>;

const Albedos& searched_albedos() {
  static const Albedos albedos = {
      Eigen::Vector3f(0.000f, 0.000f, 0.000f), Eigen::Vector3f(0.500f, 0.044f, 0.040f),  // red
      Eigen::Vector3f(0.022f, 0.500f, 0.120f),                                           // green
      Eigen::Vector3f(0.024f, 0.066f, 0.500f),                                           // blue
      Eigen::Vector3f(0.500f, 0.455f, 0.053f),                                           // yellow
      Eigen::Vector3f(0.500f, 0.020f, 0.500f),                                           // magenta
      Eigen::Vector3f(0.071f, 0.500f, 0.476f),                                           // turquoise
      Eigen::Vector3f(0.485f, 0.218f, 0.500f),                                           // pink
      Eigen::Vector3f(0.199f, 0.500f, 0.031f),                                           // lime
      Eigen::Vector3f(0.130f, 0.043f, 0.500f),                                           // violet
      Eigen::Vector3f(0.208f, 0.488f, 0.500f),                                           // sky blue
  };
  return albedos;
}

/// Another dye lot: channel by channel a few percent off, the same for every run.
Albedos other_dyes() {
  Albedos albedos = searched_albedos();
  for (int label = 1; label <= kColorCount; ++label) {
    for (int channel = 0; channel < 3; ++channel) {
      const int step = (label * 5 + channel * 3) % 7 - 3;  // -3..3
      albedos[label][channel] *= 1.0f + 0.015f * static_cast<float>(step);
    }
  }
  return albedos;
}

}  // namespace

const std::array<Eigen::Vector3f, kColorCount + 1>& glove_albedos(Shader shader) {
  static const Albedos second = other_dyes();
  return shader == Shader::first_subject ? searched_albedos() : second;
}

const std::array<Rgb, kColorCount + 1>& label_palette() {
  static const std::array<Rgb, kColorCount + 1> palette = [] {
    std::array<Rgb, kColorCount + 1> colors{};
    for (int label = 1; label <= kColorCount; ++label) {
      for (int channel = 0; channel < 3; ++channel) {
        // Twice the albedo: as bright as the screen allows.
        const double coded = srgb_encode(2.0 * searched_albedos()[label][channel]);
        colors[label][channel] = static_cast<uint8_t>(std::lround(255 * std::min(1.0, coded)));
      }
    }
    return colors;
  }();
  return palette;
}

}  // namespace glovebench::render
