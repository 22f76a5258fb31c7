#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/calibration/chroma.h"
#include "core/segmentation/color_table.h"

namespace glovebench::calibration {

/// What the glove's ten colors look like under some light: where a calibration begins. Index 0 is unused.
using ColorSeeds = std::array<Chroma, kColorCount + 1>;

/// The middle of each color's cells in a table. Throws Error naming `where` and the color that has none.
ColorSeeds seeds_of_table(const ColorTable& table, const std::string& where);

/// Reads {"format": "glovebench-glove-colors", "version": 1, "colors_rgb": [[R, G, B], ...]}: the ten colors in the
/// order of the labels, as a picture shows them in an even light, 0..255, none black. Throws Error naming `where`
/// and the field.
ColorSeeds parse_glove_colors(std::string_view text, const std::string& where);

/// A color table, or a list of colors, by what the file holds. Throws Error.
ColorSeeds load_seeds(const std::string& path);

}  // namespace glovebench::calibration
