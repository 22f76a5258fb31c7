#pragma once

#include <span>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"

namespace glovebench::eval {

/// The plan with another tracker.
Plan with_tracker(Plan plan, const TrackerConfig& tracker);

/// Runs the plan with each tracker: a list for each, in the order of the plan. The trackers see the same images,
/// which are rendered once. Times of stages are of a second pass over the first frames of each experiment's first
/// seed, one job at a time, in which the trackers take turns frame by frame. Throws: as `execute`.
std::vector<std::vector<MeasuredRun>> run_settings(Workbench& workbench, const Plan& plan,
                                                   std::span<const TrackerConfig> trackers,
                                                   const RunOptions& options);

}  // namespace glovebench::eval
