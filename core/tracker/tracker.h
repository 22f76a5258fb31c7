#pragma once

#include <memory>

#include "core/database/database.h"
#include "core/hand/hand_model.h"
#include "core/tracker/sighting.h"
#include "core/tracker/smoother.h"

namespace glovebench {

struct FrameTrace : Sighting {
  LabelImage tiny;  ///< of the last stage; empty without a hand
};

/// Throws: Error if the configuration is impossible, or side, tiny images or color spaces differ.
void check_inputs(const TrackerConfig& config, const HandModel& model, const Database& database,
                  const ColorTable& table);
/// `tracked` unless the alignment had no answer.
TrackStatus status_of(AlignmentStatus status);

/// Color-glove tracking of one hand from device frames in time order.
/// Paper: Schröder et al. 2012.
class Tracker {
 public:
  /// Throws: Error as `check_inputs`.
  Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
          std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table);

  TrackResult track(const DeviceFrame& frame, const StageObserver& observe = {});
  /// Processes the whole images; changes nothing.
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
