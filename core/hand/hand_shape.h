#pragma once

#include <array>

#include "core/hand/rigged_mesh.h"

namespace glovebench {

/// How a subject's hand differs from the mesh of the package.
struct HandShape {
  double scale = 1.0;  ///< of the whole hand
  /// Relative length of each segment: thumb metacarpal, proximal, distal; then proximal, intermediate, distal of
  /// index, middle, ring, little.
  std::array<double, 15> segment_scale = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  double patch_border_shift = 0.0;  ///< how far the patch borders lie towards the fingertips, m

  friend bool operator==(const HandShape&, const HandShape&) = default;
};

/// The second subject: 5% larger, segments +-8%, patch borders shifted by 2 mm.
HandShape second_subject();

/// The mesh with its segments stretched along their bones and the whole hand scaled, in the bind pose. The mesh is
/// in the hand frame, with the forearm.
RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape);

}  // namespace glovebench
