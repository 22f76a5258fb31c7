#pragma once

#include "core/camera/pinhole_camera.h"
#include "core/pose/interpolate.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// What the database says about the hand in a labeled image (sections III-B and III-C).
struct HandLookUp {
  TrackStatus status = TrackStatus::no_hand;  ///< tracked, no_hand or poor_match
  Square square;                              ///< around the labels
  RecycledVector<Match> matches;
  CoarseEstimate coarse;  ///< the mean of the matches; if tracked
};
/// Tiny images, look-up, and the mean of the matches. `labels` are an image of `camera`. `observe` is told the
/// stages.
HandLookUp look_up_hand(const LabelImage& labels, const PinholeCamera& camera, const Database& database,
                        const LookupConfig& config, const StageObserver& observe);

}  // namespace glovebench
