#pragma once

#include <vector>

#include "eval/run.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::eval {

struct MeasuredRun {
  Run run;
  std::vector<reports::FrameErrors> errors;  ///< by frame
};

/// `subject`: the rendered hand.
std::vector<reports::FrameErrors> measure(const Run& run, const HandModel& tracker_hand,
                                          const render::Subject& subject);
/// On the workbench's threads, in the order of `runs`.
std::vector<MeasuredRun> measure(Workbench& workbench, std::vector<Run> runs);

}  // namespace glovebench::eval
