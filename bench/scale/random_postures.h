#pragma once

#include "core/database/posture_set.h"

namespace glovebench::bench {

/// So many postures: every angle drawn evenly from within its limits, a straight wrist. The first ones do not
/// depend on how many there are.
PostureSet random_postures(int count);

}  // namespace glovebench::bench
