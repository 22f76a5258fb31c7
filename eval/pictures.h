#pragma once

#include "eval/plan.h"
#include "reports/estimates.h"
#include "reports/page/gallery.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// Chart scripts, sheets of Figures 5 and 6 if they were run, and the worst frames (paper's method only).
/// Throws: Error if the program's data are missing.
reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const reports::RunResult& result,
                                    const std::vector<reports::ExperimentEstimates>& estimates);

/// The command that shows the frame of the run in `folder`, with the flags that a user's own trajectory or database
/// needs.
std::string complete_command(const reports::WorstFrame& worst, const std::string& folder = ".");

/// All tracker stages of one frame, tracked alone, so without the filter; its errors against the truth.
/// Throws: Error if the frame does not exist or the method is not the paper's.
ColorImage explain_frame(Workbench& workbench, const RunSpec& spec, int frame);

}  // namespace glovebench::eval
