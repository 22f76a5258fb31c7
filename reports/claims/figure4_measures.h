#pragma once

#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// figure4.*, figure5.* and figure6.* of data/claims.json, if run with subject 1 and the paper's noise (gradient
/// x 1). Figure 4's intervals resample a trajectory's databases together; empty if their frames differ.
/// Paper: Figures 4 to 6.
std::vector<Measure> figure4_measures(const RunResult& result);

}  // namespace glovebench::reports
