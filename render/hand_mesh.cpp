#include "render/hand_mesh.h"

#include <map>

namespace glovebench::render {

HandMesh make_hand_mesh(std::span<const Triangle> triangles) {
  HandMesh mesh;
  std::map<std::pair<uint32_t, uint8_t>, uint32_t> index_of;
  for (const Triangle& triangle : triangles) {
    for (const uint32_t vertex : triangle.vertices) {
      const auto next = static_cast<uint32_t>(mesh.source.size());
      const auto [entry, is_new] = index_of.try_emplace({vertex, triangle.patch}, next);
      if (is_new) {
        mesh.source.push_back(vertex);
        mesh.labels.push_back(triangle.label);
        mesh.patches.push_back(static_cast<uint8_t>(triangle.patch + 1));
      }
      mesh.indices.push_back(entry->second);
    }
  }
  return mesh;
}

std::vector<Eigen::Vector3f> spread(const HandMesh& mesh, std::span<const Eigen::Vector3f> values) {
  std::vector<Eigen::Vector3f> result(mesh.source.size());
  for (size_t i = 0; i < result.size(); ++i) result[i] = values[mesh.source[i]];
  return result;
}

std::vector<Eigen::Vector3f> vertex_normals(std::span<const Triangle> triangles, const PosedHand& hand) {
  std::vector<Eigen::Vector3f> normals(hand.vertices.size(), Eigen::Vector3f::Zero());
  for (const Triangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const Eigen::Vector3f normal = (hand.vertices[b] - hand.vertices[a]).cross(hand.vertices[c] - hand.vertices[a]);
    for (const uint32_t vertex : triangle.vertices) normals[vertex] += normal;
  }
  for (Eigen::Vector3f& normal : normals) normal.normalize();
  return normals;
}

}  // namespace glovebench::render
