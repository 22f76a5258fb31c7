#pragma once

#include <span>

#include "core/calibration/glove_colors.h"

namespace glovebench::calibration {

/// Views beside their labels, and the (U, V) plane with the table's regions, pixels and Gaussians.
ColorImage color_picture(std::span<const VolumeView> views, const ColorSamples& samples, const GloveColorFit& fit,
                         const ColorTable& table);

}  // namespace glovebench::calibration
