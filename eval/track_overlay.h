#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/image.h"
#include "core/hand/hand_model.h"
#include "core/kinect/device.h"
#include "core/tracker/track_result.h"
#include "render/label_renderer.h"

namespace glovebench::eval {

class PictureSink;

/// Draws the tracked hand's outline and joints over color images.
class TrackOverlay {
 public:
  /// `path`: a folder of PNG files, FOLDER/000042.png, or a video of 30 frames/s (*.mp4) by ffmpeg, which is
  /// FILE.partial.mp4 until `finish`.
  /// Throws: Error unless the folder is new or empty, for another ending, or without ffmpeg.
  TrackOverlay(const std::string& path, std::shared_ptr<const HandModel> hand, const RgbdCalibration& calibration);
  ~TrackOverlay();

  /// A lost frame shows the reason.
  /// Throws: Error.
  void add(int number, const DeviceFrame& frame, const TrackResult& result);
  /// Throws: Error.
  void finish();

 private:
  ColorImage picture(const DeviceFrame& frame, const TrackResult& result);

  std::unique_ptr<PictureSink> sink_;
  std::shared_ptr<const HandModel> hand_;
  RgbdCalibration calibration_;
  render::LabelRenderer renderer_;
};

}  // namespace glovebench::eval
