#pragma once

#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// figure4.*, figure5.* and figure6.* of data/claims.json, if run, from subject 1 with the paper's noise (gradient
/// x 1). Intervals of Figure 4 resample seeds and frames of a trajectory together for its databases. They are empty
/// if the databases' frames differ.
/// Paper: Figures 4 to 6.
std::vector<Measure> figure4_measures(const RunResult& result);

}  // namespace glovebench::reports
