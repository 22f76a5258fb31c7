#pragma once

#include "core/pose/articulated_fit.h"
#include "core/tracker/sighting.h"

namespace glovebench {

/// Input of the fit of pose and posture.
struct HandView {
  RecycledVector<LabeledPoint> points;  ///< camera frame, m; none at a surface's edge
  HandMask mask;

  /// `seen` must be `tracked`. Reuses memory.
  void assign(const Sighting& seen, const DeviceFrame& frame);
};

}  // namespace glovebench
