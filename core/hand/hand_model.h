#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/hand/posture.h"

namespace glovebench {

/// The 25 joints of the WebXR hand and, last, the forearm.
inline constexpr int kJointCount = 26;
inline constexpr int kForearmJoint = 25;
/// 20 glove patches: 14 finger segments, thenar, palm x2, back x2, cuff.
inline constexpr int kPatchCount = 20;

/// How a subject's hand differs from the mesh of the package.
struct HandShape {
  double scale = 1.0;  ///< of the whole hand
  /// Relative length of each finger segment: thumb metacarpal, proximal, distal; then proximal, intermediate,
  /// distal of index, middle, ring, little.
  std::array<double, 15> segment_scale = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  double patch_border_shift = 0.0;  ///< how far patch borders are moved towards the fingertips, m

  friend bool operator==(const HandShape&, const HandShape&) = default;
};

/// The second subject: 5% larger, segments +-8%, patch borders shifted by 2 mm.
HandShape second_subject();

struct Triangle {
  std::array<uint32_t, 3> vertices;  ///< counter-clockwise seen from outside
  uint8_t label;                     ///< color, 1..kColorCount
  uint8_t patch;                     ///< 0..kPatchCount-1
};

/// The hand in one posture, in the hand frame (metres): rooted at the palm, origin midway between the wrist
/// joint and the middle MCP, -z to the fingertips, +y dorsal.
struct PosedHand {
  std::vector<Eigen::Vector3f> vertices;
  std::array<Eigen::Isometry3d, kJointCount> T_hand_joint;
};

/// The rigged, gloved hand: kinematics, linear blend skinning, and a closed mesh cut along the patch borders.
class HandModel {
 public:
  /// Loads the mesh (generic-hand/right.glb of npm @webxr-input-profiles/assets 1.0.20). Throws Error if the
  /// file is missing or is not that file (checksum).
  static HandModel load(const std::string& mesh_path, Side side = Side::right, const HandShape& shape = {});

  PosedHand pose(const Posture& posture) const;
  const std::vector<Triangle>& triangles() const { return triangles_; }
  size_t vertex_count() const { return rest_vertices_.size(); }
  Side side() const { return side_; }
  const HandShape& shape() const { return shape_; }
  /// Hash of the mesh after cutting, with its weights and skeleton: changes whenever the model does.
  const std::string& hash() const { return hash_; }

 private:
  friend class HandModelBuilder;
  struct Influence {
    std::array<uint8_t, 4> joint;
    std::array<float, 4> weight;
  };

  Side side_ = Side::right;
  HandShape shape_;
  std::vector<Eigen::Vector3f> rest_vertices_;
  std::vector<Influence> influences_;
  std::vector<Triangle> triangles_;
  std::array<Eigen::Isometry3d, kJointCount> T_hand_joint_rest_;
  std::array<Eigen::Isometry3d, kJointCount> T_parent_joint_zero_;  ///< all angles zero
  std::string hash_;
};

/// Index of a joint by its WebXR name ("thumb-tip"); throws Error if there is none.
int joint_index(const std::string& webxr_name);
/// The fingertip joints, thumb to little.
const std::array<int, 5>& fingertip_joints();
/// For each angle the patches that it moves (bit p = patch p): used to tell observed from hidden joints.
const std::array<uint32_t, kAngleCount>& patches_moved();
/// The color label 1..kColorCount of each patch.
const std::array<uint8_t, kPatchCount>& patch_labels();

}  // namespace glovebench
