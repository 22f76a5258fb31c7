#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/calibration/hand_views.h"
#include "core/hand/hand_shape.h"

namespace glovebench::calibration {

struct HandMesh {
  std::string path;
  Side side = Side::right;
};

struct PatchFit {
  int64_t points = 0;
  double residual = 0;  ///< mean distance of points from the surface, m
};

struct HandFit {
  HandShape shape;
  HandSizes deviation{};                ///< standard deviations, if the heights are right
  std::array<bool, kSizeCount> seen{};  ///< the recording tells more than the prior
  std::vector<ArticulatedPose> poses;   ///< one per view
  double residual_before = 0,
         residual = 0;  ///< mean distance of points from mesh and from fitted hand, m
  std::array<PatchFit, kPatchCount> patches{};
};

/// Fits a hand's shape, with pose and posture in each view. Each round refines the poses and takes a Gauss-Newton
/// step of all sizes. From the second round on, patches and (if the views show both sides) heights move to the
/// points. What the views do not show stays near the mesh. Uses the caller's TBB arena. Threads do not change
/// results.
HandFit fit_hand_shape(std::span<const TrackedView> views, const PinholeCamera& camera, const HandMesh& mesh);

}  // namespace glovebench::calibration
