#pragma once

#include "core/segmentation/color_table.h"

namespace glovebench {

/// Builds a color table from views whose true labels are known: labeled images under several lightings, with
/// everything that is not glove (skin, table, background, clutter) as label 0.
class ColorCalibration {
 public:
  /// Adds every pixel of a view. `labels` has the size of `color`; 0 = not glove. Pixels next to a border
  /// between labels mix two colors and are left out.
  void add_view(const ColorImage& color, const LabelImage& labels);
  /// The table. Throws Error if a color was never seen.
  ColorTable build() const;

 private:
  std::vector<std::array<uint32_t, kColorCount + 1>> counts_ =
      std::vector<std::array<uint32_t, kColorCount + 1>>(ColorTable::kCells);
};

}  // namespace glovebench
