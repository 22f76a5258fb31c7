#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

/// Up to four joints that move a vertex; weights are >= 0 and sum to 1, unused slots have weight 0.
struct Influence {
  std::array<uint8_t, 4> joint = {0, 0, 0, 0};
  std::array<float, 4> weight = {0, 0, 0, 0};

  float weight_of(int j) const;
};

/// A closed triangle mesh with a bind pose. All coordinates in one frame, metres.
struct RiggedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Influence> influences;               ///< one a vertex
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<Eigen::Isometry3d> T_mesh_joint;     ///< bind pose, by joint index (skeleton.h)
};

/// Hash of the package's mesh file.
inline constexpr std::string_view kRiggedMeshHash = "1e3af8c1f6637a9241aa2102f28a11bb";

/// Loads generic-hand/right.glb of npm `@webxr-input-profiles/assets` 1.0.20, welded by position. The frame is the
/// file's. Throws Error if the file is missing, altered (checksum), or cannot be parsed.
RiggedMesh load_rigged_mesh(const std::string& path);

/// Cuts the flat cap off the wrist end of a mesh in the hand frame, extrudes `length` metres of forearm from the
/// opening, closes it, adds the forearm joint at the wrist and blends its weight in over +-12 mm around it.
RiggedMesh with_forearm(const RiggedMesh& hand, double length);

}  // namespace glovebench
