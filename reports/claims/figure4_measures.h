#pragma once

#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// What claims about figures 4 to 6 rest on, from the experiments of the first subject with the paper's noise
/// (gradient x 1):
///   figure4.largest_mean_position_error_mm_source, ..._recorded   the largest of the 15 experiments' means
///   figure4.ordered_pairs_source         of 15 pairs of a trajectory and an error (position, posture RMS,
///   rotation),
///                                        those with the smallest mean for the grasp-specific database and the
///                                        largest for DB_20_postures
///   figure4.specific_best_source, figure4.large_worst_source      the same, one of the two conditions
///   figure5.position_error_mm, figure5.posture_error_deg, figure5.rotation_error_deg, figure6.*   means of the
///                                        figure's experiment, recorded truth
/// A measure is there if all experiments that it needs are. Means are over the frames that have the error.
/// Intervals of Figure 4 draw noise seeds and frames again within each trajectory, the same for all of its
/// databases; they are empty if those do not have the same frames.
std::vector<Measure> figure4_measures(const RunResult& result);

}  // namespace glovebench::reports
