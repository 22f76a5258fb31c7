#include "core/calibration/recorded_light.h"

#include <cmath>

#include "core/calibration/chroma.h"

namespace glovebench::calibration {
namespace {

constexpr double kGamma = 2.2;

double score(const ColorSeeds& seeds, const RecordedLight& light, const ChromaDensity& density) {
  // Density of stray samples around an absent color.
  constexpr double kStray = 0.002;
  // Weights of squared logarithms of gain and saturation: lights far from the seeds' are rare.
  constexpr double kRareGain = 2.0, kRareSaturation = 60.0;
  const ColorSeeds seen = relit(seeds, light);
  const double off = std::log(light.saturation);
  double sum = -kRareGain * light.gain.log().square().sum() - kRareSaturation * off * off;
  for (int label = 1; label <= kColorCount; ++label) sum += std::log(kStray + density.at(seen[label]));
  return sum;
}

/// Steps of the logarithms of the gains of red and blue and of the saturation, and how many each way.
struct Search {
  double gain_step;
  int red, blue;
  double saturation_step;
  int saturation;
};

RecordedLight best_light(const ColorSeeds& seeds, const ChromaDensity& density, const RecordedLight& start,
                         const Search& search) {
  RecordedLight best = start;
  double highest = score(seeds, best, density);
  for (int r = -search.red; r <= search.red; ++r) {
    for (int b = -search.blue; b <= search.blue; ++b) {
      for (int s = -search.saturation; s <= search.saturation; ++s) {
        RecordedLight light = start;
        light.gain[0] *= std::exp(r * search.gain_step);
        light.gain[2] *= std::exp(b * search.gain_step);
        light.saturation *= std::exp(s * search.saturation_step);
        const double value = score(seeds, light, density);
        if (value <= highest) continue;
        highest = value;
        best = light;
      }
    }
  }
  return best;
}

}  // namespace

ColorSeeds relit(const ColorSeeds& seeds, const RecordedLight& light) {
  const Eigen::Array3d coded = light.gain.pow(1 / kGamma);
  ColorSeeds seen = seeds;
  for (int label = 1; label <= kColorCount; ++label)
    seen[label] = light.saturation * chroma_of(rgb_of_chroma(seeds[label]) * coded);
  return seen;
}

RecordedLight estimate_light(const ColorSeeds& seeds, std::span<const ColorSample> samples, double min_luma) {
  const ChromaDensity coarse(samples, min_luma, 0.06), fine(samples, min_luma, 0.025);
  const RecordedLight near = best_light(seeds, coarse, {}, {0.08, 10, 20, 0.05, 3});
  return best_light(seeds, fine, near, {0.02, 6, 6, 0.0125, 6});
}

}  // namespace glovebench::calibration
