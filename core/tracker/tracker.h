#pragma once

#include <memory>
#include <span>

#include "core/database/database.h"
#include "core/hand/hand_model.h"
#include "core/tracker/sighting.h"
#include "core/tracker/smoother.h"

namespace glovebench {

/// What each stage of one frame made.
struct FrameTrace : Sighting {
  LabelImage tiny;  ///< of the last cascade stage
};

/// Throws Error if the configuration is impossible, or if model, database, color table and configuration do not
/// belong together: another side, tiny images that the cascade asks for missing, another color space.
void check_inputs(const TrackerConfig& config, const HandModel& model, const Database& database,
                  const ColorTable& table);
/// Is the best match farther away than `max_matching_error`? `matches` is not empty.
bool is_poor_match(std::span<const Match> matches, const LookupConfig& config);

/// `tracked` unless the alignment had no answer.
TrackStatus status_of(AlignmentStatus status);

/// Color-glove hand tracking after Schroeder et al. 2012: from device frames to posture and pose. Sees device
/// frames and calibration only. One tracker follows one hand; frames are given in time order.
class Tracker {
 public:
  /// Throws Error as `check_inputs` does.
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
