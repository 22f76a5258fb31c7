#pragma once

#include <span>

#include "core/calibration/glove_colors.h"

namespace glovebench::calibration {

/// Draws a picture for checking a table by eye: up to four views beside their labels (gray: none), and the (U, V)
/// plane at Y = 60 and 130 with the table's regions, similar pixels and the fitted Gaussians at two deviations.
ColorImage color_picture(std::span<const VolumeView> views, const ColorSamples& samples, const GloveColorFit& fit,
                         const ColorTable& table);

}  // namespace glovebench::calibration
