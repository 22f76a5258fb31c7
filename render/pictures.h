#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

ColorImage picture_of_labels(const LabelImage& labels);
/// Warm: near. Black: no value. z_near < z_far, m.
ColorImage picture_of_depth(const DepthImage& depth, double z_near, double z_far);
/// `other` minus `depth`: blue at -`range` (m), white at 0, orange at +`range`; gray: one has no value; dark:
/// neither has. Images must have one size.
ColorImage picture_of_depth_difference(const DepthImage& depth, const DepthImage& other, double range);
/// Draws label borders with a black edge. Images must have one size.
ColorImage overlay_outline(const ColorImage& color, const LabelImage& labels, const Rgb& line = {255, 255, 255});
struct Stroke {
  Eigen::Vector2d from_px, to_px;
};
/// Lines with end dots and a dark edge.
ColorImage overlay_strokes(const ColorImage& color, std::span<const Stroke> strokes, const Rgb& line);
/// A line of ASCII at the upper left.
ColorImage overlay_text(const ColorImage& color, const std::string& text);
/// Throws: Error.
void write_png(const std::string& path, const ColorImage& image);

struct Panel {
  std::string title;
  ColorImage image;
};

/// Scales panels (nearest pixel) into rows of `columns` cells.
ColorImage montage(const std::vector<Panel>& panels, int columns, int cell_width, int cell_height);

struct TextLine {
  std::string text;
  Rgb color = {230, 230, 230};
};
/// Lines, as large as titles in a montage.
ColorImage picture_of_text(const std::vector<TextLine>& lines, int width, int height);

/// The whole image if nothing is labeled.
ColorImage crop_to_labels(const ColorImage& image, const LabelImage& labels, int margin);

}  // namespace glovebench::render
