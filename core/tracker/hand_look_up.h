#pragma once

#include "core/camera/pinhole_camera.h"
#include "core/pose/interpolate.h"
#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// The database's answer for a label image.
/// Paper: sections III-B and III-C.
struct HandLookUp {
  TrackStatus status = TrackStatus::no_hand;  ///< tracked, no_hand or poor_match
  Square square;
  RecycledVector<Match> matches;
  CoarseEstimate coarse;  ///< mean of the matches, if tracked
};
HandLookUp look_up_hand(const LabelImage& labels, const PinholeCamera& camera, const Database& database,
                        const LookupConfig& config, const StageObserver& observe);

}  // namespace glovebench
