#pragma once

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

struct RegistrationConfig {
  /// A depth pixel gets no color when another surface lies this much nearer (m, > 0) on the same ray of the
  /// RGB camera.
  double occlusion_tolerance = 0.015;
};

/// The mapped image M (section III-A): the color of each depth pixel.
struct RegisteredImage {
  ColorImage color;          ///< IR camera's pixels
  Image<uint8_t> has_color;  ///< 1 where the RGB camera sees the depth pixel, else 0
};

/// Maps color to the pixel coordinates of the depth image. Depth pixels without a value, outside the RGB
/// image, or hidden from the RGB camera behind a nearer surface get no color. Images and calibration are rectified.
RegisteredImage register_color(const DepthImage& depth, const ColorImage& color, const RgbdCalibration& calibration,
                               const RegistrationConfig& config);

}  // namespace glovebench
