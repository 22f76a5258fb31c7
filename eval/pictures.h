#pragma once

#include "eval/plan.h"
#include "reports/estimates.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// Chart scripts, sheets of Figures 5 and 6 if run, and the worst frames (paper's method only).
/// Throws: Error without the program's data.
reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const reports::RunResult& result,
                                    const std::vector<reports::ExperimentEstimates>& estimates);

/// All tracker stages of one frame, tracked alone and so without filter.
/// Throws: Error if the frame does not exist or the method is not the paper's.
ColorImage explain_frame(Workbench& workbench, const RunSpec& spec, int frame);

}  // namespace glovebench::eval
