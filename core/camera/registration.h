#pragma once

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

struct RegistrationConfig {
  /// A surface nearer by more on the RGB ray hides a pixel, m, > 0.
  double occlusion_tolerance = 0.015;
};

/// The mapped image M.
/// Paper: section III-A.
struct RegisteredImage {
  ColorImage color;          ///< in IR pixels
  Image<uint8_t> has_color;  ///< 1: seen by the RGB camera
};

/// Maps colors to the depth image. Inputs must be rectified. Pixels without depth, hidden, or outside the RGB image
/// get no color.
RegisteredImage register_color(const DepthImage& depth, const ColorImage& color, const RgbdCalibration& calibration,
                               const RegistrationConfig& config);

}  // namespace glovebench
