#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/glove_colors.h"

namespace glovebench::calibration {

/// How well a table tells the colors of its recording apart. Index 0: not glove, or no label.
struct ColorSeparation {
  /// [what a pixel is][what the table says], shares of 1 in a row. A color's pixels are drawn from its bell with
  /// the camera's noise, at the five brightnesses of GloveColor::lumas; those that are not glove are the
  /// recording's own. A row without pixels is empty.
  std::array<std::optional<std::array<double, kColorCount + 1>>, kColorCount + 1> confusion;
  std::array<int, kColorCount + 1> nearest{};              ///< the color nearest to each
  std::array<double, kColorCount + 1> nearest_distance{};  ///< to it, chroma
  /// The same in deviations of the two bells along the line between their centers, with the camera's noise.
  std::array<double, kColorCount + 1> nearest_deviations{};
  double unlabeled_share = 0;  ///< of the recording's glove pixels, mixed ones too: without a label in the table
  double mixed_unlabeled_share = 0;  ///< of the mixed ones alone; 0 if there are none
};
ColorSeparation separate_colors(const ColorSamples& samples, const GloveColorFit& fit, const ColorTable& table);

/// What to know before the table is used: colors that were seen too little, that lie close together, that lie where
/// the seeds would not have them; clutter in the glove's colors; overexposed or dark pixels. A sentence each.
std::vector<std::string> color_warnings(const ColorSamples& samples, const GloveColorFit& fit,
                                        const ColorSeparation& separation);

/// The report as JSON (README.md lists the keys), and as Markdown.
nlohmann::ordered_json color_report_json(const ColorSamples& samples, const GloveColorFit& fit,
                                         const ColorSeparation& separation, const std::string& recording);
std::string color_report_markdown(const ColorSamples& samples, const GloveColorFit& fit,
                                  const ColorSeparation& separation);

}  // namespace glovebench::calibration
