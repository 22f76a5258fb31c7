#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

/// A recording that OpenNI2 plays once. Images are never mirrored. Not thread-safe.
class OniPlayer {
 public:
  virtual ~OniPlayer() = default;
  /// By the color camera's fields of view. Takes depth as registered to color: recordings do not say.
  /// Throws: Error if the fields of view are missing, or depth and color have different shapes.
  virtual RgbdCalibration calibration() const = 0;
  virtual double steps_per_m() const = 0;  ///< of depth

  // The image of that time. Times must increase for each kind.
  // Throws: Error if OpenNI2 shows none.
  virtual Image<uint16_t> depth_steps(int64_t time_us) = 0;
  virtual ColorImage color(int64_t time_us) = 0;
};

extern const bool kHasOpenNi2;

/// OpenNI2 trusts what it reads: check the file before.
/// Throws: Error if OpenNI2 does not open it, this build lacks OpenNI2, or a stream is missing or not DEPTH_1_MM,
/// DEPTH_100_UM or RGB888.
std::unique_ptr<OniPlayer> open_oni(const std::string& path);

}  // namespace glovebench
