#pragma once

#include <optional>
#include <string>

#include "core/hand/hand_model.h"
#include "core/kinect/device.h"
#include "core/tracker/track_result.h"
#include "render/label_renderer.h"

namespace glovebench::eval {

/// Writes the frames of a recording with the tracked hand over them, its outline and joints, to PNG files.
class TrackOverlay {
 public:
  /// Throws: Error unless `folder` is new or empty.
  TrackOverlay(const std::string& folder, std::shared_ptr<const HandModel> hand,
               const RgbdCalibration& calibration);

  /// Writes FOLDER/000042.png. A lost frame shows why it was lost.
  /// Throws: Error.
  void add(int number, const DeviceFrame& frame, const TrackResult& result);

 private:
  ColorImage picture(const DeviceFrame& frame, const TrackResult& result);

  std::string folder_;
  std::shared_ptr<const HandModel> hand_;
  RgbdCalibration calibration_;
  render::LabelRenderer renderer_;
};

}  // namespace glovebench::eval
