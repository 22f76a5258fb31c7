#pragma once

#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

/// One picture of a montage, with the line of text above it.
struct Panel {
  std::string title;
  ColorImage image;
};

/// Panels in rows of `columns`, each scaled (nearest pixel) to fit a cell of the given size, on dark gray.
ColorImage montage(const std::vector<Panel>& panels, int columns, int cell_width, int cell_height);

/// The part of an image within the rectangle that holds all labeled pixels, with a margin; the whole image if there
/// are none.
ColorImage crop_to_labels(const ColorImage& image, const LabelImage& labels, int margin);

}  // namespace glovebench::render
