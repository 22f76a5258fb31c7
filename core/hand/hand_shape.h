#pragma once

#include <array>
#include <string>

#include "core/hand/rigged_mesh.h"

namespace glovebench {

/// Sizes are factors on the package's mesh. `kScale` is of the whole hand; others are relative to it. Segments:
/// metacarpal, proximal, distal of the thumb; proximal, intermediate, distal of index, middle, ring, little.
inline constexpr int kSegmentCount = 15;
enum HandSize : int {
  kScale,
  kPalmBreadth,
  kPalmThickness,
  kKnuckleArch,      ///< palmar distance of the other MCPs from the middle one
  kThumbPalmLength,  ///< from wrist to the thumb's first joint, along the palm
  kIndexPalmLength,  ///< to the MCP; the middle finger has none
  kRingPalmLength,
  kLittlePalmLength,
  kSegmentLengths,  ///< first of kSegmentCount
  kSegmentWidths = kSegmentLengths + kSegmentCount,
  kSizeCount = kSegmentWidths + kSegmentCount,
};
using HandSizes = std::array<double, kSizeCount>;
inline constexpr double kLeastHandSize = 0.3, kMostHandSize = 2;

/// Names in files, such as "index_proximal_length".
const std::array<std::string, kSizeCount>& hand_size_names();

/// How a gloved hand differs from the package's mesh.
struct HandShape {
  HandSizes sizes = [] {
    HandSizes ones;
    ones.fill(1);
    return ones;
  }();
  double patch_border_shift = 0;  ///< towards the fingertips, m
};

/// 5% larger, segments +-8%, patch borders shifted by 2 mm.
HandShape second_subject();

/// Scales the hand and stretches palm and segments, without `patch_border_shift`. `mesh`: hand frame, bind pose,
/// with forearm.
RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape);

}  // namespace glovebench
