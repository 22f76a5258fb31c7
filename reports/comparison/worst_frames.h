#pragma once

#include <vector>

#include "reports/comparison/comparison.h"

namespace glovebench::reports {

/// The frames whose vertex error grew most, by more than 0.01 mm, at most kWorstFrames of them. A frame that was
/// lost counts as 50 mm, the bound of a covered frame. Of frames close together in one experiment, which show the
/// same failure, the worst. None where a result has no vertex errors.
std::vector<ChangedFrame> worst_frames(const Pairing& pairing);

}  // namespace glovebench::reports
