#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

/// A recording that OpenNI2 plays once, from the beginning. Images are as the camera sees them, never mirrored.
/// Not thread-safe.
class OniPlayer {
 public:
  virtual ~OniPlayer() = default;
  /// By the color camera's fields of view. Takes depth as registered to color: recordings do not say.
  /// Throws: Error if the fields of view are missing, or depth and color have different shapes.
  virtual RgbdCalibration calibration() const = 0;
  virtual double steps_per_m() const = 0;  ///< of depth

  // The image of that time. A kind's earlier images are gone then, so times must increase.
  // Throws: Error if OpenNI2 shows none.
  virtual Image<uint16_t> depth_steps(int64_t time_us) = 0;
  virtual ColorImage color(int64_t time_us) = 0;
};

extern const bool kHasOpenNi2;

/// OpenNI2 trusts what it reads, so check the file before.
/// Throws: Error if OpenNI2 does not open it, a stream is missing or has another format than DEPTH_1_MM,
/// DEPTH_100_UM or RGB888, or this build lacks OpenNI2.
std::unique_ptr<OniPlayer> open_oni(const std::string& path);

}  // namespace glovebench
