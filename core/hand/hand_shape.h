#pragma once

#include <array>
#include <string>

#include "core/hand/rigged_mesh.h"

namespace glovebench {

/// The sizes in which hands differ, as factors on those of the package's mesh. `kScale` is of the whole hand; all
/// others are relative to it. Segments: metacarpal, proximal and distal of the thumb; proximal, intermediate and
/// distal of index, middle, ring and little.
inline constexpr int kSegmentCount = 15;
enum HandSize : int {
  kScale,
  kPalmBreadth,
  kPalmThickness,
  kKnuckleArch,      ///< how far the MCPs of index, ring and little lie palmar of the middle finger's
  kThumbPalmLength,  ///< along the palm, from the wrist to the thumb's first joint
  kIndexPalmLength,  ///< and to the MCPs; the middle finger's has no factor
  kRingPalmLength,
  kLittlePalmLength,
  kSegmentLengths,  ///< the first of 15
  kSegmentWidths = kSegmentLengths + kSegmentCount,
  kSizeCount = kSegmentWidths + kSegmentCount,
};
using HandSizes = std::array<double, kSizeCount>;
/// No hand has a size outside of these.
inline constexpr double kLeastHandSize = 0.3, kMostHandSize = 2;

/// Name of each size as it stands in files, e.g. "index_proximal_length".
const std::array<std::string, kSizeCount>& hand_size_names();

/// How a person's gloved hand differs from the mesh of the package.
struct HandShape {
  HandSizes sizes = [] {
    HandSizes ones;
    ones.fill(1);
    return ones;
  }();
  double patch_border_shift = 0;  ///< how far the patch borders lie towards the fingertips, m
};

/// The second subject: 5% larger, segments +-8% longer or shorter, patch borders shifted by 2 mm.
HandShape second_subject();

/// The mesh with the whole hand scaled, its palm and segments stretched. The mesh is in the hand frame, in the bind
/// pose, with the forearm. `shape.patch_border_shift` is of no account.
RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape);

}  // namespace glovebench
