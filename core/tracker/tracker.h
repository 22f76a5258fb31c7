#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "core/database/database.h"
#include "core/hand/hand_model.h"
#include "core/kinect/device.h"
#include "core/segmentation/color_table.h"
#include "core/tracker/smoother.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// What each stage of one frame made.
struct FrameTrace {
  DepthImage depth;
  RegisteredImage mapped;
  LabelImage labels;
  LabeledCloud cloud;
  LabelImage tiny;  ///< of the last cascade stage
};

/// Is there one whole hand in the cloud, so that it can be looked up? `tracked` if so, else what is wrong.
TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config);

/// Told the name of each stage when it begins ("register", "segment", ...; "" at the end of the frame), so
/// that a caller who has a clock can time them.
using StageObserver = std::function<void(std::string_view stage)>;

/// Color-glove hand tracking after Schroeder et al. 2012: from device frames to posture and pose. Sees device
/// frames and calibration only. One tracker follows one hand; frames are given in time order.
class Tracker {
 public:
  /// Throws Error if the configuration is impossible or model and database are of different sides.
  Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
          std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table);

  /// The answer for one frame. `trace`, if given, receives what each stage made (for pictures).
  TrackResult track(const DeviceFrame& frame, const StageObserver& observe = {}, FrameTrace* trace = nullptr);

  const TrackerConfig& config() const { return config_; }

 private:
  TrackResult estimate(const DeviceFrame& frame, const StageObserver& observe, FrameTrace* trace) const;

  TrackerConfig config_;
  RgbdCalibration calibration_;
  std::shared_ptr<const HandModel> model_;
  std::shared_ptr<const Database> database_;
  std::shared_ptr<const ColorTable> table_;
  Smoother smoother_;
};

}  // namespace glovebench
