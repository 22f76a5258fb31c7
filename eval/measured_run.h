#pragma once

#include <vector>

#include "eval/run.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::eval {

/// A run with its errors.
struct MeasuredRun {
  Run run;
  std::vector<reports::FrameErrors> errors;  ///< one a frame
};

/// The errors of each frame of a run. `subject` is the hand that was rendered.
std::vector<reports::FrameErrors> measure(const Run& run, const HandModel& tracker_hand,
                                          const render::Subject& subject);
/// Measures runs on the workbench's threads: output i of run i.
std::vector<MeasuredRun> measure(Workbench& workbench, std::vector<Run> runs);

}  // namespace glovebench::eval
