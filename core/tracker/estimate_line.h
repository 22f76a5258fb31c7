#pragma once

#include <string>

#include "core/tracker/track_result.h"

namespace glovebench {

/// One estimate as one line of JSON (no line end): frame, timestamp_us, status, angles_deg (22, filtered),
/// position_mm, quaternion_wxyz, matching_error_px, icp_iterations, icp_residual_mm, ambiguous, converged; of a
/// method that knows them also angle_deviations_deg (22) and hidden (names of angles). A lost frame has no posture
/// and no pose. Numbers to 1e-6 of their unit, so equal estimates are equal bytes.
std::string estimate_line(int frame, const TrackResult& result);

}  // namespace glovebench
