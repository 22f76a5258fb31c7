#pragma once

#include "eval/experiments.h"

namespace glovebench::eval {

/// One frame of a run with every stage of the tracker as a picture: what the cameras saw, the mapped image M,
/// the labels L, the tiny image, the k matches, the alignment before and after. The filter is not part of it: the
/// frame is tracked by itself. Throws Error for another method than the paper's.
ColorImage explain_frame(Workbench& workbench, const RunSpec& spec, int frame);

}  // namespace glovebench::eval
