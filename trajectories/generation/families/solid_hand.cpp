#include "trajectories/generation/families/solid_hand.h"

#include <algorithm>
#include <limits>

#include "core/hand/solid_bones.h"

namespace glovebench::trajectories {

double deepest_overlap(const Skeleton& skeleton, const Posture& posture) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const BonePair& pair : overlapping_bones(skeleton.pose(posture), deepest))
    deepest = std::max(deepest, pair.overlap);
  return deepest;
}

}  // namespace glovebench::trajectories
