#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/hand/posture.h"
#include "core/hand/rigged_mesh.h"

namespace glovebench {

/// 20 glove patches in 10 colors (section III): thumb proximal and distal; proximal, intermediate and distal of
/// index, middle, ring, little; thenar; palm radial and ulnar; back radial and ulnar; cuff.
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
  std::array<uint32_t, 3> vertices;  ///< counter-clockwise seen from outside
  uint8_t label;                     ///< color, 1..kColorCount
  uint8_t patch;                     ///< Patch
};

/// A closed mesh whose triangles each lie in one patch.
struct GlovedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Influence> influences;
  std::vector<Triangle> triangles;
};

/// The color label 1..kColorCount of each patch. Two patches of one color lie far apart on the hand, and also in a
/// fist; front and back of the palm differ.
const std::array<uint8_t, kPatchCount>& patch_labels();
/// For each angle the patches that it moves (bit p = patch p).
const std::array<uint32_t, kAngleCount>& patches_moved();

/// One score a patch.
using PatchScores = std::array<double, kPatchCount>;
/// How strongly each vertex belongs to each patch, from its weights and place. The mesh is in the hand frame, with
/// the forearm; `border_shift` moves the borders towards the fingertips, m.
std::vector<PatchScores> patch_scores(const RiggedMesh& mesh, double border_shift);

/// Cuts each triangle along the lines where the largest of the linearly interpolated scores changes. New vertices
/// on an edge depend on that edge alone, so that both its triangles get the same ones and the mesh stays closed.
GlovedMesh cut_patches(const RiggedMesh& mesh, const std::vector<PatchScores>& scores);

}  // namespace glovebench
