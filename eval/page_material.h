#pragma once

#include "eval/experiments.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// What the page of a finished plan shows beside its numbers: the scripts of its charts, the frames of Figures 5
/// and 6 where they were run, and the worst frames with every stage of the tracker. Depends on the outcome's
/// results and estimates alone. Throws Error if the program's data are missing.
reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const Outcome& outcome);

}  // namespace glovebench::eval
