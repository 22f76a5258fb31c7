#pragma once

#include <vector>

#include "eval/studies/ablation_runs.h"

namespace glovebench::eval {

/// A look-up that is off by more than this is wrong: about a quarter of the way from the open hand to the power
/// grasp (57 degrees).
inline constexpr double kWrongLookUp_deg = 15;

/// lag.frames, lag.without_filter_frames, lag.filter_share: the posture's delay. The intervals draw movements.
std::vector<reports::Measure> lag_measures(const AblationRuns& runs);

/// By what alignment without colors is worse in frames whose look-up is wrong, with DB_20_postures and
/// DB_open_pinch_power together: color.blind_excess_position_mm, color.blind_excess_rotation_deg.
std::vector<reports::Measure> color_measures(const AblationRuns& runs);
/// The table "color_blind": the same frames, for each of the two databases.
reports::Table color_table(const AblationRuns& runs);

/// interpolation.distinct_excess_deg: posture error, before the filter, of 3 neighbors minus that of 1, in frames
/// where the 3 are not all of one posture.
reports::Measure interpolation_measure(const AblationRuns& runs);

/// The rows that these need and that `ablations` may not have.
std::vector<Ablation> measured_ablations();

}  // namespace glovebench::eval
