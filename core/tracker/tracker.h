#pragma once

#include <memory>

#include "core/database/database.h"
#include "core/hand/hand_model.h"
#include "core/tracker/sighting.h"
#include "core/tracker/smoother.h"

namespace glovebench {

/// What the stages make of one frame, for pictures.
struct FrameTrace : Sighting {
  LabelImage tiny;  ///< of the last cascade stage; empty where there is no hand to look up
};

/// Throws Error if the configuration is impossible, or if model, database, color table and configuration do not
/// belong together: another side, tiny images that the cascade asks for missing, another color space.
void check_inputs(const TrackerConfig& config, const HandModel& model, const Database& database,
                  const ColorTable& table);
/// `tracked` unless the alignment had no answer.
TrackStatus status_of(AlignmentStatus status);

/// Color-glove hand tracking after Schroeder et al. 2012: from device frames to posture and pose. Sees device
/// frames and calibration only. One tracker follows one hand; frames are given in time order.
class Tracker {
 public:
  /// Throws Error as `check_inputs` does.
  Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
          std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table);

  /// The answer for one frame. `observe` is told each stage when it begins.
  TrackResult track(const DeviceFrame& frame, const StageObserver& observe = unobserved);
  /// What the stages make of the whole images, also of what lies beyond the working volume. Changes nothing.
  FrameTrace inspect(const DeviceFrame& frame) const;

  const TrackerConfig& config() const { return config_; }

 private:
  TrackResult estimate(const DeviceFrame& frame, const StageObserver& observe) const;

  TrackerConfig config_;
  RgbdCalibration calibration_;
  std::shared_ptr<const HandModel> model_;
  std::shared_ptr<const Database> database_;
  std::shared_ptr<const ColorTable> table_;
  Smoother smoother_;
};

}  // namespace glovebench
