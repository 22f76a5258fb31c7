#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/hand/posture.h"
#include "core/hand/rigged_mesh.h"

namespace glovebench {

/// 20 patches in 10 colors.
/// Paper: section III.
inline constexpr int kPatchCount = 20;
enum Patch : uint8_t {
  kThumbProximal,
  kThumbDistal,
  kIndexProximal,
  kIndexIntermediate,
  kIndexDistal,
  kMiddleProximal,
  kMiddleIntermediate,
  kMiddleDistal,
  kRingProximal,
  kRingIntermediate,
  kRingDistal,
  kLittleProximal,
  kLittleIntermediate,
  kLittleDistal,
  kThenar,
  kPalmRadial,
  kPalmUlnar,
  kBackRadial,
  kBackUlnar,
  kCuff,
};

struct Triangle {
  std::array<uint32_t, 3> vertices;  ///< counter-clockwise from outside
  uint8_t label;                     ///< 1..kColorCount
  uint8_t patch;
};

/// A closed mesh. Each triangle lies in one patch.
struct GlovedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Influence> influences;
  std::vector<Triangle> triangles;
};

const std::array<std::string_view, kPatchCount>& patch_names();
/// Patches of one color are far apart, even in a fist.
const std::array<uint8_t, kPatchCount>& patch_labels();
/// Bit p: the angle moves patch p.
const std::array<uint32_t, kAngleCount>& patches_moved();

using PatchScores = std::array<double, kPatchCount>;
/// How strongly a vertex belongs to each patch. `mesh`: hand frame, with forearm. `border_shift`: towards the
/// fingertips, m.
std::vector<PatchScores> patch_scores(const RiggedMesh& mesh, double border_shift);

/// Points around a vertex that were seen in a patch's color.
struct PatchVotes {
  uint32_t vertex;
  uint8_t patch;
  int points;

  bool operator==(const PatchVotes&) const = default;
};
/// Moves the borders to where the points were seen.
void add_votes(std::vector<PatchScores>& scores, std::span<const PatchVotes> votes);

/// Cuts triangles where the best interpolated score changes. The mesh stays closed.
GlovedMesh cut_patches(const RiggedMesh& mesh, const std::vector<PatchScores>& scores);

}  // namespace glovebench
