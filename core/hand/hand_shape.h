#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/hand/glove.h"

namespace glovebench {

/// Factors on the package's mesh. `kScale` is the whole hand's; others are relative to it. Segments: thumb
/// metacarpal, proximal, distal; index, middle, ring, little proximal, intermediate, distal.
inline constexpr int kSegmentCount = 15;
enum HandSize : int {
  kScale,
  kPalmBreadth,
  kPalmThickness,
  kKnuckleArch,      ///< palmar distance of other MCPs from the middle's
  kThumbPalmLength,  ///< wrist to thumb's first joint, along the palm
  kIndexPalmLength,  ///< wrist to MCP; the middle finger has none
  kRingPalmLength,
  kLittlePalmLength,
  kSegmentLengths,  ///< first of kSegmentCount
  kSegmentWidths = kSegmentLengths + kSegmentCount,
  kSizeCount = kSegmentWidths + kSegmentCount,
};
using HandSizes = std::array<double, kSizeCount>;
inline constexpr double kLeastHandSize = 0.3, kMostHandSize = 2;
inline constexpr double kMostBorderShift = 0.006;  ///< m
inline constexpr double kMostHeight = 0.01;        ///< m

/// Names in files, such as "index_proximal_length".
const std::array<std::string, kSizeCount>& hand_size_names();

/// Differences from the package's mesh.
struct HandShape {
  HandSizes sizes = [] {
    HandSizes ones;
    ones.fill(1);
    return ones;
  }();
  double patch_border_shift = 0;  ///< subject 2's, towards the fingertips, m, up to kMostBorderShift either way
  /// Height of each vertex of the mesh along its normal, m, from -kMostHeight to kMostHeight. Empty: all 0.
  std::vector<double> heights = {};
  std::vector<PatchVotes> patch_votes = {};
};

/// Subject 2 (render/README.md).
HandShape second_subject();

/// Applies sizes and heights, not what moves the patches. `mesh`: hand frame, bind pose, with forearm.
RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape);

}  // namespace glovebench
