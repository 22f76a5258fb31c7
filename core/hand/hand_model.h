#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/recycled_vector.h"
#include "core/hand/glove.h"
#include "core/hand/posture.h"
#include "core/hand/rigged_mesh.h"
#include "core/hand/skeleton.h"

namespace glovebench {

/// Differences from the package's mesh.
struct HandShape {
  double scale = 1.0;
  /// relative lengths: thumb metacarpal, proximal, distal; then proximal, intermediate, distal of index to little
  std::array<double, 15> segment_scale = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  double patch_border_shift = 0.0;  ///< towards the fingertips, m

  friend bool operator==(const HandShape&, const HandShape&) = default;
};

/// 5% larger, segments +-8%, borders shifted by 2 mm.
HandShape second_subject();

/// Applies a shape to a mesh with forearm, in the hand frame and bind pose.
RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape);

/// The hand in the hand frame, m: origin midway between the wrist joint and the middle MCP, -z to the fingertips,
/// +y dorsal.
struct PosedHand {
  RecycledVector<Eigen::Vector3f> vertices;
  JointPoses T_hand_joint;
};

/// The gloved hand: kinematics, linear blend skinning and a closed mesh.
class HandModel {
 public:
  /// Loads generic-hand/right.glb of npm `@webxr-input-profiles/assets` 1.0.20.
  /// Throws: Error if the file is missing or its checksum differs.
  static HandModel load(const std::string& mesh_path, Side side = Side::right, const HandShape& shape = {});

  PosedHand pose(const Posture& posture) const;
  const std::vector<Triangle>& triangles() const { return triangles_; }
  size_t vertex_count() const { return bind_vertices_.size(); }
  const std::vector<Influence>& influences() const { return influences_; }
  Side side() const { return side_; }
  /// The right hand's; the left hand mirrors it.
  const Skeleton& skeleton() const { return skeleton_; }
  const HandShape& shape() const { return shape_; }
  /// Hash of cut mesh, weights and skeleton.
  const std::string& hash() const { return hash_; }

 private:
  Side side_ = Side::right;
  HandShape shape_;
  Skeleton skeleton_;
  std::vector<Eigen::Vector3d> bind_vertices_;
  std::vector<Influence> influences_;
  JointPoses T_joint_bind_;
  std::vector<Triangle> triangles_;
  std::string hash_;
};

}  // namespace glovebench
