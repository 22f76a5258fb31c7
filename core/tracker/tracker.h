#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/camera/pinhole_camera.h"
#include "core/database/database.h"
#include "core/hand/hand_model.h"
#include "core/pose/interpolate.h"
#include "core/tracker/sighting.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

struct FrameTrace : Sighting {
  LabelImage tiny;  ///< of the last stage; empty without a hand
};
/// Runs the stages before the look-up on whole images.
FrameTrace inspect(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
                   const TrackerConfig& config);

/// Throws: Error for an impossible configuration, or if side, tiny images or color spaces differ.
void check_inputs(const TrackerConfig& config, const HandModel& model, const Database& database,
                  const ColorTable& table);
/// `tracked` for `converged` and `not_converged`.
TrackStatus status_of(AlignmentStatus status);

/// Tracks one hand, frames in time order.
/// Paper: Schröder et al. 2012.
class Tracker {
 public:
  /// Throws: Error as `check_inputs`.
  Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
          std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table);

  /// `previous`: earlier results in time order; the newest `smoothing.forget_after` suffice.
  TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous = {},
                    const StageObserver& observe = unobserved) const;

 private:
  TrackResult estimate(const DeviceFrame& frame, const StageObserver& observe) const;

  TrackerConfig config_;
  RgbdCalibration calibration_;
  std::shared_ptr<const HandModel> model_;
  std::shared_ptr<const Database> database_;
  std::shared_ptr<const ColorTable> table_;
};

/// The look-up's result for a label image.
/// Paper: sections III-B and III-C.
struct HandLookUp {
  TrackStatus status = TrackStatus::no_hand;  ///< tracked, no_hand or poor_match
  Square square;
  std::optional<Eigen::Vector3d> ray;  ///< to which the rotations are turned; empty: not turned
  RecycledVector<Match> matches;
  CoarseEstimate coarse;  ///< mean of the matches, if tracked
};
HandLookUp look_up_hand(const LabelImage& labels, const PinholeCamera& camera, const Database& database,
                        const LookupConfig& config, const StageObserver& observe);

}  // namespace glovebench
