#pragma once

#include <vector>

#include "core/calibration/hand_views.h"

namespace glovebench::calibration {

/// Sums over the points around each vertex of the mesh.
struct SeenSurface {
  explicit SeenSurface(size_t vertices) : height(vertices), weight(vertices), votes(vertices) {}
  SeenSurface& operator+=(const SeenSurface& other);

  std::vector<double> height;  ///< weighted sum of the points' heights, m
  std::vector<double> weight;
  std::vector<std::array<double, kPatchCount>> votes;  ///< points in the color of each patch
};

/// A hand with the patches and without them, in one shape.
struct HandAndMesh {
  HandModel gloved;
  HandModel plain;
};

/// A point belongs to the nearest face of any color, and to the patch of the nearest face of its color.
SeenSurface seen_surface(const HandAndMesh& hand, const TrackedView& view, const ArticulatedPose& pose);

/// Smooth heights that fit the points best, near 0 where no points are. `before`: the heights of `plain`, m.
std::vector<double> heights_of(const SeenSurface& seen, const HandModel& plain, std::vector<double> before);

std::vector<PatchVotes> votes_of(const SeenSurface& seen);

}  // namespace glovebench::calibration
