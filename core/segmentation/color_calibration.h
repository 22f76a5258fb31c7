#pragma once

#include "core/segmentation/color_table.h"

namespace glovebench {

/// How far a calibration reaches beyond the lightings that it has seen, and how sure a label must be.
struct ColorModel {
  double strength_factor = 2.5;           ///< light weaker and stronger by up to this factor, >= 1
  double temperature_shift_mired = 50.0;  ///< warmer and colder light by up to this, >= 0
  double not_glove_prior = 0.95;          ///< share of pixels that are not glove, (0, 1)
  double kept_share = 0.995;              ///< of a color's pixels; rarer shades are left unlabeled, (0, 1]
  double min_posterior = 0.7;             ///< of the label given the cell, [0, 1)
  int min_luma = 28;                      ///< darker cells tell no color, 0..255
};

/// Builds a color table from views whose true labels are known: labeled images under several lightings, with
/// everything that is not glove (skin, table, background, clutter) as label 0.
class ColorCalibration {
 public:
  /// `space`: of the table.
  explicit ColorCalibration(ColorSpace space = ColorSpace::yuv) : space_(space) {}

  /// Adds every pixel of a view. `labels` has the size of `color`; 0 = not glove. Pixels next to a border
  /// between labels mix two colors and are left out.
  void add_view(const ColorImage& color, const LabelImage& labels);
  /// Adds one pixel, which must show one color alone. `label`: 0..kColorCount.
  void add_pixel(const Rgb& color, uint8_t label);
  /// The table. Each seen color is also relit within the limits of `model` (gains on gamma-coded RGB, which clip
  /// at white), and a cell gets the label that is the most probable there (Bayes) if it is sure enough. Throws
  /// Error if a glove color was never seen bright enough to be told.
  ColorTable build(const ColorModel& model = {}) const;

 private:
  ColorSpace space_;
  std::vector<std::array<uint32_t, kColorCount + 1>> counts_ =
      std::vector<std::array<uint32_t, kColorCount + 1>>(ColorTable::kCells);
};

}  // namespace glovebench
