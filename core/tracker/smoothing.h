#pragma once

#include <span>

#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// Among the newest `count` results. Null if all of these were lost.
const TrackResult* last_tracked(std::span<const TrackResult> previous, int count);

/// Filters by x = keep * previous + (1 - keep) * new. A lost frame repeats the last values; `forget_after` lost
/// frames restart the filter. `previous`: earlier results in time order; the newest `forget_after` suffice. Paper:
/// section III-C, as its printed numbers show.
TrackResult smoothed(TrackResult result, std::span<const TrackResult> previous, const SmoothingConfig& config);

}  // namespace glovebench
