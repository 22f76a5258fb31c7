#include "core/hand/hand_shape.h"

#include <algorithm>

#include "core/hand/skeleton.h"

namespace glovebench {
namespace {

/// Joint at the base of each segment.
constexpr std::array<int, kSegmentCount> kStretchedJoint = {1, 2, 3, 6, 7, 8, 11, 12, 13, 16, 17, 18, 21, 22, 23};

/// By joint, in the joint's frame: the bone lies along z. What hangs on a fingertip's joint is as wide as the
/// distal segment.
std::array<Eigen::Vector3d, kJointCount> segment_stretch(const HandSizes& sizes) {
  std::array<Eigen::Vector3d, kJointCount> stretch;
  stretch.fill(Eigen::Vector3d::Ones());
  for (int s = 0; s < kSegmentCount; ++s) {
    const double width = sizes[kSegmentWidths + s];
    stretch[kStretchedJoint[s]] = {width, width, sizes[kSegmentLengths + s]};
    if (s % 3 == 2) stretch[kStretchedJoint[s] + 1] = {width, width, 1};
  }
  return stretch;
}

/// How a place stretches that moves with the palm, in the hand frame. `joint` tells on which finger's ray it lies;
/// rays stretch from the wrist on.
struct PalmStretch {
  Eigen::Vector3d factors;
  double z_shift;

  PalmStretch(const HandSizes& sizes, int joint, double z_wrist) {
    const auto along = [&] {
      if (joint == 1) return sizes[kThumbPalmLength];
      if (joint == 5 || joint == 6) return sizes[kIndexPalmLength];
      if (joint == 15 || joint == 16) return sizes[kRingPalmLength];
      if (joint == 20 || joint == 21) return sizes[kLittlePalmLength];
      return 1.0;
    }();
    const bool is_mcp = joint == 6 || joint == 16 || joint == 21;
    const double arch = is_mcp ? sizes[kKnuckleArch] : 1;
    factors = {sizes[kPalmBreadth], arch * sizes[kPalmThickness], along};
    z_shift = (1 - along) * z_wrist;
  }
  Eigen::Affine3d transform() const {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    T.linear().diagonal() = factors;
    T.translation().z() = z_shift;
    return T;
  }
  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const {
    return factors.cwiseProduct(p) + z_shift * Eigen::Vector3d::UnitZ();
  }
};

}  // namespace

const std::array<std::string, kSizeCount>& hand_size_names() {
  static const std::array<std::string, kSizeCount> names = [] {
    std::array<std::string, kSizeCount> all = {"scale",
                                               "palm_breadth",
                                               "palm_thickness",
                                               "knuckle_arch",
                                               "thumb_palm_length",
                                               "index_palm_length",
                                               "ring_palm_length",
                                               "little_palm_length"};
    const std::array<std::string, 5> fingers = {"thumb", "index", "middle", "ring", "little"};
    for (int s = 0; s < kSegmentCount; ++s) {
      const std::array<std::string, 3> segments = {s < 3 ? "metacarpal" : "proximal",
                                                   s < 3 ? "proximal" : "intermediate", "distal"};
      const std::string segment = fingers[s / 3] + "_" + segments[s % 3];
      all[kSegmentLengths + s] = segment + "_length";
      all[kSegmentWidths + s] = segment + "_width";
    }
    return all;
  }();
  return names;
}

HandShape second_subject() {
  HandShape shape;
  shape.sizes[kScale] = 1.05;
  constexpr std::array<double, kSegmentCount> kLengths = {1.04, 0.93, 1.08, 0.96, 1.07, 0.92, 1.06, 0.95,
                                                          1.08, 0.92, 1.05, 1.03, 1.08, 0.94, 0.97};
  std::ranges::copy(kLengths, shape.sizes.begin() + kSegmentLengths);
  shape.patch_border_shift = 0.002;
  return shape;
}

RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape) {
  const std::array<Eigen::Vector3d, kJointCount> stretch = segment_stretch(shape.sizes);
  const double z_wrist = mesh.T_mesh_joint[kWristJoint].translation().z();
  RiggedMesh result = mesh;
  std::vector<Eigen::Affine3d> T_new_old(mesh.T_mesh_joint.size());
  for (int j = 0; j < static_cast<int>(mesh.T_mesh_joint.size()); ++j) {
    const int parent = joint_parents()[j];
    const PalmStretch palm(shape.sizes, j, z_wrist);
    if (parent < 0) {
      result.T_mesh_joint[j].translation() = palm(mesh.T_mesh_joint[j].translation());
    } else {
      const Eigen::Vector3d offset = (mesh.T_mesh_joint[parent].inverse() * mesh.T_mesh_joint[j]).translation();
      result.T_mesh_joint[j].translation() =
          result.T_mesh_joint[parent] * Eigen::Vector3d(offset.x(), offset.y(), offset.z() * stretch[parent].z());
    }
    const bool is_palm = parent < 0 && std::ranges::find(kStretchedJoint, j) == kStretchedJoint.end();
    const Eigen::Isometry3d& T_mesh_joint = is_palm ? mesh.T_mesh_joint[j] : result.T_mesh_joint[j];
    T_new_old[j] = T_mesh_joint * Eigen::Scaling(stretch[j]) * Eigen::Affine3d(mesh.T_mesh_joint[j].inverse());
    if (is_palm) T_new_old[j] = palm.transform() * T_new_old[j];
  }
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Influence& influence = mesh.influences[v];
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i)
      p += static_cast<double>(influence.weight[i]) * (T_new_old[influence.joint[i]] * mesh.vertices[v]);
    result.vertices[v] = shape.sizes[kScale] * p;
  }
  for (Eigen::Isometry3d& T : result.T_mesh_joint) T.translation() *= shape.sizes[kScale];
  if (!shape.heights.empty()) {
    const std::vector<Eigen::Vector3d> normals = vertex_normals(result);
    for (size_t v = 0; v < result.vertices.size(); ++v) result.vertices[v] += shape.heights.at(v) * normals[v];
  }
  return result;
}

}  // namespace glovebench
