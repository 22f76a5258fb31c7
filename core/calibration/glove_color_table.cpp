#include <algorithm>
#include <optional>

#include "core/calibration/glove_colors.h"

namespace glovebench::calibration {
namespace {

/// Approximates sRGB's curve. Colors mix in linear light.
Eigen::Array3d linear(const Rgb& rgb) { return (array_of(rgb) / 255).pow(2.2); }

/// The share of `near` in a mixed pixel. Empty if the pixel is no mix of the two.
std::optional<double> share_of_near(const MixedSample& mixed) {
  constexpr double kOff = 0.15;  // of the two colors' distance
  const Eigen::Vector3d near = linear(mixed.near), other = linear(mixed.other), pixel = linear(mixed.rgb);
  const Eigen::Vector3d along = near - other;
  const double share = along.dot(pixel - other) / along.squaredNorm();
  if (share < 0 || share > 1.2) return {};
  if ((other + share * along - pixel).norm() > kOff * along.norm()) return {};
  return share;
}

/// Adds the pixels that mix two colors under the label of the one that they hold more of.
void add_mixed(const ColorSamples& samples, const GloveColorFit& fit, ColorCalibration& calibration) {
  for (const MixedSample& mixed : samples.mixed()) {
    const uint8_t near = fit.classify(mixed.near), other = fit.classify(mixed.other);
    if (near == kUnsure || (mixed.other_is_inside && other == kUnsure)) continue;
    const std::optional<double> share = share_of_near(mixed);
    if (!share) continue;
    if (*share >= 0.5) calibration.add_pixel(mixed.rgb, near);
    if (*share < 0.5 && mixed.other_is_inside) calibration.add_pixel(mixed.rgb, other);
  }
}

}  // namespace

ColorModel recorded_color_model() {
  ColorModel model;
  model.strength_factor = 1.6;
  model.temperature_shift_mired = 20;
  model.kept_share = 0.999;
  model.min_posterior = 0.5;
  model.min_luma = 16;
  return model;
}

ColorTable build_color_table(const ColorSamples& samples, const GloveColorFit& fit, ColorSpace space) {
  ColorCalibration calibration(space);
  for (const ColorSample& sample : samples.inside()) {
    const uint8_t label = fit.classify(sample.rgb);
    if (label != kUnsure) calibration.add_pixel(sample.rgb, label);
  }
  if (fit.config.mixed_pixels) add_mixed(samples, fit, calibration);
  // Takes about as many pixels beyond the volume as there are in it without glove, and some in any case.
  const int64_t wanted = std::max<int64_t>(fit.other, fit.glove / 20);
  const size_t stride = static_cast<size_t>(std::max<int64_t>(1, fit.beyond / std::max<int64_t>(1, wanted)));
  for (size_t i = 0; i < samples.beyond().size(); i += stride) {
    const Rgb& rgb = samples.beyond()[i].rgb;
    if (fit.classify(rgb) == kNotGlove) calibration.add_pixel(rgb, kNotGlove);
  }
  ColorModel model = fit.config.model;
  const double share = static_cast<double>(fit.other) / static_cast<double>(fit.other + fit.glove);
  model.not_glove_prior = std::clamp(share, 0.05, 0.95);
  return calibration.build(model);
}

}  // namespace glovebench::calibration
