#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/recycled_vector.h"
#include "core/hand/glove.h"
#include "core/hand/hand_shape.h"
#include "core/hand/posture.h"
#include "core/hand/skeleton.h"

namespace glovebench {

/// Hand frame, m.
struct PosedHand {
  RecycledVector<Eigen::Vector3f> vertices;
  JointPoses T_hand_joint;
};

/// The gloved hand: skeleton, linear blend skinning, closed mesh.
class HandModel {
 public:
  /// Loads generic-hand/right.glb of npm `@webxr-input-profiles/assets` 1.0.20.
  /// Throws: Error if it is missing or its checksum differs.
  static HandModel load(const std::string& mesh_path, Side side = Side::right, const HandShape& shape = {});
  /// The same in one color, with the vertices and triangles of the mesh.
  static HandModel load_plain(const std::string& mesh_path, Side side, const HandShape& shape);

  /// This hand with sizes times `factors`. Unlike in `load`, patches keep their places on the skin, and heights
  /// stretch with it.
  HandModel stretched(const HandSizes& factors) const;

  PosedHand pose(const Posture& posture) const;
  const std::vector<Triangle>& triangles() const { return triangles_; }
  size_t vertex_count() const { return bind_vertices_.size(); }
  const std::vector<Influence>& influences() const { return influences_; }
  Side side() const { return side_; }
  /// The right hand's; a left hand mirrors it.
  const Skeleton& skeleton() const { return skeleton_; }
  const HandShape& shape() const { return shape_; }
  /// Hash of cut mesh, weights and skeleton.
  const std::string& hash() const { return hash_; }

 private:
  HandModel(Side side, HandShape shape, GlovedMesh glove, std::span<const Eigen::Isometry3d> T_hand_joint);
  void bind(std::vector<Eigen::Vector3d> vertices, std::span<const Eigen::Isometry3d> T_hand_joint);
  std::string make_hash(const JointPoses& T_hand_joint) const;

  Side side_ = Side::right;
  HandShape shape_;
  Skeleton skeleton_;
  std::vector<Eigen::Vector3d> bind_vertices_;
  std::vector<Influence> influences_;
  JointPoses T_joint_bind_;
  std::vector<Triangle> triangles_;
  std::string hash_;
};

/// Point q moves by axis x q + moment per radian. Hand frame, m.
struct Screw {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit length, right-handed
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
std::array<Screw, kAngleCount> angle_screws(const HandModel& model, const PosedHand& hand);

/// Palm, three segments of each finger, forearm.
inline constexpr int kBodyCount = 17;
/// Bits of the angles that move a body; 0 for the palm, body 0.
uint32_t angles_of_body(int body);
/// A surface point's shares of bodies, sum 1.
using BodyShares = std::array<float, kBodyCount>;
std::vector<BodyShares> body_shares(const HandModel& model);

/// How much a surface point follows each angle, 0..1: its shares of bodies that the angle moves.
using AngleShares = Eigen::Matrix<float, kAngleCount, 1>;
AngleShares angle_shares(const BodyShares& shares);

}  // namespace glovebench
