#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/calibration/hand_views.h"
#include "core/hand/hand_shape.h"

namespace glovebench::calibration {

/// The mesh and side of the hand that is fitted.
struct HandMesh {
  std::string path;
  Side side = Side::right;
};

/// How the points of one patch lie to the fitted hand.
struct PatchFit {
  int64_t points = 0;
  double residual = 0;  ///< mean distance, m
};

struct HandFit {
  HandShape shape;
  HandSizes deviation{};                     ///< standard deviation of each size
  std::array<bool, kSizeCount> seen{};       ///< the recording tells more of the size than people's differences do
  std::vector<ArticulatedPose> poses;        ///< one a view
  double residual_before = 0, residual = 0;  ///< mean distance of the points: as the mesh is, and as fitted, m
  std::array<PatchFit, kPatchCount> patches{};
};

/// Fits the sizes of a hand to views of it, together with its pose and posture in each: rounds of poses refined
/// with the hand as it is, then one Gauss-Newton step of all sizes with poses and postures eliminated (Schur), then
/// the shift of the patch borders. Sizes that the views do not show stay near those of the mesh. Uses the threads
/// of the caller's TBB arena; the result does not depend on their number.
HandFit fit_hand_shape(std::span<const TrackedView> views, const PinholeCamera& camera, const HandMesh& mesh);

}  // namespace glovebench::calibration
