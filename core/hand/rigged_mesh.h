#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

/// Up to four joints. Weights are >= 0 and sum to 1.
struct Influence {
  std::array<uint8_t, 4> joint = {0, 0, 0, 0};
  std::array<float, 4> weight = {0, 0, 0, 0};

  float weight_of(int j) const;
};

/// A closed mesh in bind pose, m.
struct RiggedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Influence> influences;               ///< by vertex
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<Eigen::Isometry3d> T_mesh_joint;     ///< by joint (skeleton.h)
};

inline constexpr std::string_view kRiggedMeshHash = "1e3af8c1f6637a9241aa2102f28a11bb";

/// Vertices of that mesh with its forearm.
inline constexpr size_t kRiggedMeshVertices = 1260;

/// Loads HandModel::load's file in its own frame. Welds vertices by position.
/// Throws: Error as HandModel::load.
RiggedMesh load_rigged_mesh(const std::string& path);

/// Replaces the wrist's cap by a forearm of `length` m, blended over +-12 mm. `hand`: hand frame.
RiggedMesh with_forearm(const RiggedMesh& hand, double length);

std::vector<Eigen::Vector3d> vertex_normals(const RiggedMesh& mesh);

}  // namespace glovebench
