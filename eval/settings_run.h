#pragma once

#include <span>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"

namespace glovebench::eval {

Plan with_tracker(Plan plan, const TrackerConfig& tracker);

/// Runs the plan with each tracker, on images rendered once. Returns a list per tracker, in the plan's order.
/// Stage times come from a second pass over the first frames of each experiment's first seed, one job at a time,
/// trackers in turn for each frame.
/// Throws: as `execute`.
std::vector<std::vector<MeasuredRun>> run_settings(Workbench& workbench, const Plan& plan,
                                                   std::span<const TrackerConfig> trackers,
                                                   const RunOptions& options);

}  // namespace glovebench::eval
