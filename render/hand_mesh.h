#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/hand/hand_model.h"

namespace glovebench::render {

/// Triangles for drawing. Each patch has its own vertices.
struct HandMesh {
  std::vector<uint32_t> source;   ///< vertex of the hand
  std::vector<uint8_t> labels;    ///< 1..kColorCount
  std::vector<uint8_t> patches;   ///< patch + 1
  std::vector<uint32_t> indices;  ///< in the hand's order
};
HandMesh make_hand_mesh(std::span<const Triangle> triangles);

/// Copies the hand's values to the mesh's vertices.
std::vector<Eigen::Vector3f> spread(const HandMesh& mesh, std::span<const Eigen::Vector3f> values);

/// Area-weighted unit normals, outward, hand frame.
std::vector<Eigen::Vector3f> vertex_normals(std::span<const Triangle> triangles, const PosedHand& hand);

}  // namespace glovebench::render
