#pragma once

#include <span>

#include "core/calibration/glove_colors.h"

namespace glovebench::calibration {

/// A picture to check a table by eye. At the left four of the views at most, cut to what is labeled, each beside
/// its labels, painted in the glove's own colors (gray: in the volume without a label). At the right the (U, V)
/// plane, dark at Y = 60 and bright at Y = 130: the table's regions, on them the recording's pixels of about that Y
/// and the fitted bells at two deviations of the colors that are about as bright.
ColorImage color_picture(std::span<const VolumeView> views, const ColorSamples& samples, const GloveColorFit& fit,
                         const ColorTable& table);

}  // namespace glovebench::calibration
