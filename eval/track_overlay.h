#pragma once

#include <memory>
#include <string>

#include "core/hand/hand_model.h"
#include "core/kinect/device.h"
#include "core/tracker/track_result.h"
#include "eval/picture_sink.h"
#include "render/label_renderer.h"

namespace glovebench::eval {

/// Draws the tracked hand's outline and joints over color images.
class TrackOverlay {
 public:
  /// `path`: as open_picture_sink.
  /// Throws: Error.
  TrackOverlay(const std::string& path, std::shared_ptr<const HandModel> hand, const RgbdCalibration& calibration);

  /// A lost frame shows the reason.
  /// Throws: Error.
  void add(int number, const DeviceFrame& frame, const TrackResult& result);
  void finish() { sink_->finish(); }

 private:
  ColorImage picture(const DeviceFrame& frame, const TrackResult& result);

  std::unique_ptr<PictureSink> sink_;
  std::shared_ptr<const HandModel> hand_;
  RgbdCalibration calibration_;
  render::LabelRenderer renderer_;
};

}  // namespace glovebench::eval
