#include "core/hand/hand_shape.h"

#include "core/hand/skeleton.h"

namespace glovebench {
namespace {

/// Joint at the base of each of the 15 segments.
constexpr std::array<int, 15> kScaledJoint = {1, 2, 3, 6, 7, 8, 11, 12, 13, 16, 17, 18, 21, 22, 23};

std::array<double, kJointCount> stretch_by_joint(const HandShape& shape) {
  std::array<double, kJointCount> stretch;
  stretch.fill(1.0);
  for (size_t s = 0; s < kScaledJoint.size(); ++s) stretch[kScaledJoint[s]] = shape.segment_scale[s];
  return stretch;
}

}  // namespace

HandShape second_subject() {
  HandShape shape;
  shape.scale = 1.05;
  shape.segment_scale = {1.04, 0.93, 1.08, 0.96, 1.07, 0.92, 1.06, 0.95, 1.08, 0.92, 1.05, 1.03, 1.08, 0.94, 0.97};
  shape.patch_border_shift = 0.002;
  return shape;
}

RiggedMesh reshaped(const RiggedMesh& mesh, const HandShape& shape) {
  const std::array<double, kJointCount> stretch = stretch_by_joint(shape);
  RiggedMesh result = mesh;
  std::vector<Eigen::Affine3d> T_new_old(mesh.T_mesh_joint.size());
  for (size_t j = 0; j < mesh.T_mesh_joint.size(); ++j) {
    const int parent = joint_parents()[j];
    if (parent >= 0) {
      Eigen::Vector3d offset = (mesh.T_mesh_joint[parent].inverse() * mesh.T_mesh_joint[j]).translation();
      offset.z() *= stretch[parent];
      result.T_mesh_joint[j].translation() = result.T_mesh_joint[parent] * offset;
    }
    T_new_old[j] = result.T_mesh_joint[j] * Eigen::Scaling(1.0, 1.0, stretch[j]) *
                   Eigen::Affine3d(mesh.T_mesh_joint[j].inverse());
  }
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Influence& influence = mesh.influences[v];
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) {
      p += static_cast<double>(influence.weight[i]) * (T_new_old[influence.joint[i]] * mesh.vertices[v]);
    }
    result.vertices[v] = shape.scale * p;
  }
  for (Eigen::Isometry3d& T : result.T_mesh_joint) T.translation() *= shape.scale;
  return result;
}

}  // namespace glovebench
