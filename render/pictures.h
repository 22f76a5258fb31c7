#pragma once

#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

/// Labels in the glove's colors on black.
ColorImage picture_of_labels(const LabelImage& labels);
/// Depth as colors, near is warm, far is cold; black where there is no value. Range in metres, z_near < z_far.
ColorImage picture_of_depth(const DepthImage& depth, double z_near, double z_far);
/// Where two hands differ: `other` minus `depth` from blue (-range, m, and less: nearer) over white (0) to orange
/// (+range and more), ends that any color vision tells apart; gray where only one of the two has a value, dark
/// where none has. Both images have one size.
ColorImage picture_of_depth_difference(const DepthImage& depth, const DepthImage& other, double range);
/// The color image with a line along the borders of the labeled areas (outer and between colors), e.g. those of the
/// estimated hand. Both images have one size.
ColorImage overlay_outline(const ColorImage& color, const LabelImage& labels, const Rgb& line = {255, 255, 255});
/// The bytes of a PNG file.
std::string encode_png(const ColorImage& image);
/// The bytes of a JPEG file; quality 0 to 100. Smaller than a PNG, and for looking only.
std::string encode_jpeg(const ColorImage& image, int quality);
/// Writes a PNG, whole or not at all. Throws Error if the file cannot be written.
void write_png(const std::string& path, const ColorImage& image);

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
