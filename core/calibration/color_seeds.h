#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/calibration/chroma.h"
#include "core/calibration/color_samples.h"
#include "core/segmentation/color_table.h"

namespace glovebench::calibration {

/// Chroma of the glove's colors before calibration. Index 0 is unused.
using ColorSeeds = std::array<Chroma, kColorCount + 1>;

/// Each color's mean cell.
/// Throws: Error for a color without cells.
ColorSeeds seeds_of_table(const ColorTable& table, const std::string& where);

/// Reads "glovebench-glove-colors" (README.md). No color may be black.
/// Throws: Error.
ColorSeeds parse_glove_colors(std::string_view text, const std::string& where);

/// Reads a color table or a list of colors.
/// Throws: Error.
ColorSeeds load_seeds(const std::string& path);

/// Change of light and camera from seeds to recording.
struct RecordedLight {
  Eigen::Array3d gain = Eigen::Array3d::Ones();  ///< of linear R, G, B; G = 1
  /// Factor of chroma: > 1 in weak light, < 1 with haze or reflections.
  double saturation = 1;
};

ColorSeeds relit(const ColorSeeds& seeds, const RecordedLight& light);

/// Puts the seeds where samples are dense. Without samples: no change.
RecordedLight estimate_light(const ColorSeeds& seeds, std::span<const ColorSample> samples, double min_luma);

}  // namespace glovebench::calibration
