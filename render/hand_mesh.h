#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/hand/hand_model.h"

namespace glovebench::render {

/// A hand's triangles for drawing: a vertex on a patch border stands once for each of its patches, so that label
/// and patch belong to vertices.
struct HandMesh {
  std::vector<uint32_t> source;   ///< vertex of the hand
  std::vector<uint8_t> labels;    ///< 1..kColorCount
  std::vector<uint8_t> patches;   ///< patch + 1
  std::vector<uint32_t> indices;  ///< three a triangle, in the hand's order
};
HandMesh make_hand_mesh(std::span<const Triangle> triangles);

/// One value per vertex of the mesh, from one per vertex of the hand.
std::vector<Eigen::Vector3f> spread(const HandMesh& mesh, std::span<const Eigen::Vector3f> values);

/// Unit normals of the posed hand's vertices in the hand frame, area-weighted, pointing outwards.
std::vector<Eigen::Vector3f> vertex_normals(std::span<const Triangle> triangles, const PosedHand& hand);

}  // namespace glovebench::render
