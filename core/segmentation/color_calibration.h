#pragma once

#include "core/segmentation/color_table.h"

namespace glovebench {

/// How far to extend the seen light, and how sure labels must be.
struct ColorModel {
  double strength_factor = 2.5;           ///< of weaker and stronger light, >= 1
  double temperature_shift_mired = 50.0;  ///< warmer and colder light, >= 0
  double not_glove_prior = 0.95;          ///< share of pixels, (0, 1)
  double kept_share = 0.995;              ///< of a color's pixels; rarer shades get no label; (0, 1]
  double min_posterior = 0.7;             ///< of a cell's label, [0, 1)
  int min_luma = 28;                      ///< darker cells get no label, 0..255
  /// Cells of each channel that share a label: 1, 2, 4...
  std::array<int, 3> pooled = {1, 1, 1};
};

/// Builds a color table from labeled views under several lightings.
class ColorCalibration {
 public:
  explicit ColorCalibration(ColorSpace space = ColorSpace::yuv) : space_(space) {}

  /// Skips pixels beside a label border. Label 0: not glove. All images have one size.
  void add_view(const ColorImage& color, const LabelImage& labels);
  /// `label`: 0..kColorCount.
  void add_pixel(const Rgb& color, uint8_t label);
  /// Relights seen colors by `model`. Each cell gets its most probable label.
  /// Throws: Error if a glove color was never bright enough.
  ColorTable build(const ColorModel& model = {}) const;

 private:
  ColorSpace space_;
  std::vector<std::array<uint32_t, kColorCount + 1>> counts_ =
      std::vector<std::array<uint32_t, kColorCount + 1>>(ColorTable::kCells);
};

}  // namespace glovebench
