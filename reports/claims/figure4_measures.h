#pragma once

#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// Measures from subject 1 with the paper's noise (gradient x 1), as far as run:
///   figure4.largest_mean_position_error_mm_source, _recorded   largest of 15 means
///   figure4.ordered_pairs_source   pairs of 15 (trajectory, error) in which the grasp-specific database has the
///                                  smallest mean and DB_20_postures the largest
///   figure4.specific_best_source, figure4.large_worst_source   the same, one condition each
///   figure5.*, figure6.*   means on recorded truth
/// Errors: position, posture RMS, rotation, over frames that have them. Intervals of Figure 4 resample seeds and
/// frames of each trajectory, alike for its databases; empty if their frames differ.
/// Paper: Figures 4 to 6.
std::vector<Measure> figure4_measures(const RunResult& result);

}  // namespace glovebench::reports
