#pragma once

#include "eval/plan.h"
#include "reports/estimates.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// What the page of a finished plan shows beside its numbers: the scripts of its charts, the frames of Figures 5
/// and 6 where they were run, and the worst frames with every stage of the tracker. Throws Error if the program's
/// data are missing.
reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const reports::RunResult& result,
                                    const std::vector<reports::ExperimentEstimates>& estimates);

/// One frame of a run with every stage of the tracker as a picture: what the cameras saw, the mapped image M,
/// the labels L, the tiny image, the k matches, the alignment before and after. The filter is not part of it: the
/// frame is tracked by itself. Throws Error for another method than the paper's.
ColorImage explain_frame(Workbench& workbench, const RunSpec& spec, int frame);

}  // namespace glovebench::eval
