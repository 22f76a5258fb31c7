#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/calibration/glove_colors.h"

namespace glovebench::calibration {

/// A table's separation of a recording's colors. Index 0: "not glove" or "no label".
struct ColorSeparation {
  /// [true color][table's label], shares of a row, from the color's Gaussian with camera noise. Empty without
  /// pixels.
  std::array<std::optional<std::array<double, kColorCount + 1>>, kColorCount + 1> confusion;
  std::array<int, kColorCount + 1> nearest{};              ///< label
  std::array<double, kColorCount + 1> nearest_distance{};  ///< chroma
  /// Distance of centers / sum of deviations along it.
  std::array<double, kColorCount + 1> nearest_deviations{};
  double unlabeled_share = 0;        ///< of glove and mixed pixels
  double mixed_unlabeled_share = 0;  ///< 0 without mixed pixels
};
ColorSeparation separate_colors(const ColorSamples& samples, const GloveColorFit& fit, const ColorTable& table);

/// One sentence per problem.
std::vector<std::string> color_warnings(const ColorSamples& samples, const GloveColorFit& fit,
                                        const ColorSeparation& separation);

/// README.md lists the keys.
nlohmann::ordered_json color_report_json(const ColorSamples& samples, const GloveColorFit& fit,
                                         const ColorSeparation& separation, const std::string& recording);
std::string color_report_markdown(const ColorSamples& samples, const GloveColorFit& fit,
                                  const ColorSeparation& separation);

/// Views with labels; the (U, V) plane with regions, pixels, Gaussians.
ColorImage color_picture(std::span<const VolumeView> views, const ColorSamples& samples, const GloveColorFit& fit,
                         const ColorTable& table);

}  // namespace glovebench::calibration
