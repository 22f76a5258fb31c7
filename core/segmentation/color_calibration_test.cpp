#include "core/segmentation/color_calibration.h"

#include <gtest/gtest.h>

#include <iostream>

#include "core/base/error.h"
#include "core/base/random.h"

namespace glovebench {
namespace {

struct Light {
  double strength = 1.0;  ///< 1: white under the light is 0.8 of full scale
  double temperature_K = 5000;
  double ambient = 0.3;  ///< share that reaches faces turned away from the light
};

/// Linear R, G, B of a black body relative to 6500 K, sampled at three wavelengths (Planck), as strong in G.
Eigen::Array3d light_color(double temperature_K) {
  const Eigen::Array3d wavelength_nm{605, 545, 455};
  const auto planck = [&](double T) {
    return Eigen::Array3d(1.0 / ((1.4388e7 / (wavelength_nm * T)).exp() - 1.0));
  };
  const Eigen::Array3d relative = planck(temperature_K) / planck(6500);
  return relative / relative[1];
}

// Linear albedos of ten glove colors, then what is not glove: skin twice, gray table, white, and clutter.
constexpr int kMaterials = 16;
const std::array<Eigen::Array3d, kMaterials> kAlbedos = {{
    {0.60, 0.03, 0.03},
    {0.70, 0.25, 0.02},
    {0.70, 0.60, 0.03},
    {0.25, 0.60, 0.03},
    {0.03, 0.35, 0.08},
    {0.03, 0.55, 0.50},
    {0.05, 0.25, 0.65},
    {0.05, 0.04, 0.45},
    {0.28, 0.05, 0.50},
    {0.70, 0.08, 0.35},
    {0.55, 0.36, 0.27},
    {0.30, 0.17, 0.11},
    {0.35, 0.35, 0.35},
    {0.75, 0.75, 0.75},
    {0.40, 0.25, 0.12},
    {0.15, 0.20, 0.30},
}};

struct View {
  ColorImage color;
  LabelImage labels;
};

/// Stripes, one a material, shaded from facing the light to turned away, with camera noise of sigma 2.
View render_view(const Light& light, int number) {
  constexpr int kStripe = 12, kWidth = 160;
  View view{ColorImage(kWidth, kStripe * kMaterials), LabelImage(kWidth, kStripe * kMaterials)};
  RandomStream random(7, "color calibration", number, "noise");
  for (int v = 0; v < view.color.height(); ++v) {
    const int material = v / kStripe;
    for (int u = 0; u < kWidth; ++u) {
      const double shade = light.ambient + (1 - light.ambient) * u / (kWidth - 1);
      const Eigen::Array3d linear =
          kAlbedos[material] * light_color(light.temperature_K) * (0.8 * light.strength * shade);
      const Eigen::Array3d coded = 255.0 * linear.min(1.0).pow(1 / 2.2);
      for (int channel = 0; channel < 3; ++channel)
        view.color(u, v)[channel] =
            static_cast<uint8_t>(std::clamp(std::round(coded[channel] + 2.0 * random.normal()), 0.0, 255.0));
      view.labels(u, v) = static_cast<uint8_t>(material < kColorCount ? material + 1 : 0);
    }
  }
  return view;
}

/// The lightings that the tables of these tests are calibrated from.
ColorCalibration calibrate() {
  ColorCalibration calibration;
  int number = 0;
  for (double temperature_K : {3500.0, 4000.0, 4500.0, 5000.0, 5700.0})
    for (double strength : {0.8, 1.2}) {
      const View view = render_view({strength, temperature_K, 0.3}, number++);
      calibration.add_view(view.color, view.labels);
    }
  return calibration;
}

struct Rates {
  double wrong = 0;   ///< of all glove-labeled pixels, those with a wrong label
  double missed = 0;  ///< of all glove pixels bright enough to tell, those without a label
};

Rates rate(const ColorTable& table, const Light& light, int number, int min_luma) {
  const View view = render_view(light, number);
  double labeled = 0, wrong = 0, bright = 0, missed = 0;
  for (size_t i = 0; i < view.color.size(); ++i) {
    const int truth = view.labels[i], found = table.label(view.color[i]);
    labeled += found > 0;
    wrong += found > 0 && found != truth;
    if (truth > 0 && yuv_from_rgb(view.color[i])[0] >= min_luma) {
      ++bright;
      missed += found == 0;
    }
  }
  return {wrong / labeled, missed / bright};
}

TEST(ColorCalibration, TellsColorsUnderHeldOutLighting) {
  const ColorTable table = calibrate().build();
  Rates mean, worst;
  int number = 1000;
  for (double temperature_K : {3000.0, 3800.0, 5200.0, 6500.0})
    for (double strength : {0.5, 1.0, 2.0})
      for (double ambient : {0.15, 0.5}) {
        const Rates rates = rate(table, {strength, temperature_K, ambient}, number++, 32);
        std::cout << temperature_K << " K x" << strength << " ambient " << ambient << ": wrong "
                  << 100 * rates.wrong << "% missed " << 100 * rates.missed << "%\n";
        mean.wrong += rates.wrong / 24;
        mean.missed += rates.missed / 24;
        worst.wrong = std::max(worst.wrong, rates.wrong);
        worst.missed = std::max(worst.missed, rates.missed);
      }
  std::cout << "mean: wrong " << 100 * mean.wrong << "% missed " << 100 * mean.missed << "%, worst: wrong "
            << 100 * worst.wrong << "% missed " << 100 * worst.missed << "%\n";
}

}  // namespace
}  // namespace glovebench
