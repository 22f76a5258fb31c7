#include "core/hand/hand_model.h"

#include <cstring>

#include "core/base/hash.h"
#include "core/hand/rigged_mesh.h"
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

constexpr double kForearmLength = 0.06;  // m past the wrist joint

/// MCP to PIP, index to little, m. The file's MCP centers sit too far proximal; these are the lengths of a
/// hand-tracking skeleton (npm iwer).
constexpr std::array<double, 4> kProximalLength = {0.0379, 0.0429, 0.0390, 0.0307};

/// Moves each MCP center along its bone so that the proximal segment has its length; weights stay.
void correct_mcp_centers(RiggedMesh& mesh) {
  for (int finger = 0; finger < 4; ++finger) {
    const int mcp = 6 + 5 * finger;
    const Eigen::Vector3d pip = mesh.T_mesh_joint[mcp + 1].translation();
    const Eigen::Vector3d bone = mesh.T_mesh_joint[mcp].translation() - pip;
    mesh.T_mesh_joint[mcp].translation() = pip + bone.normalized() * kProximalLength[finger];
  }
}

/// Hand frame: origin midway between wrist joint and middle MCP, z from the MCP to the wrist, y dorsal.
Eigen::Isometry3d hand_frame(const RiggedMesh& mesh) {
  const Eigen::Isometry3d& mcp = mesh.T_mesh_joint[joint_index("middle-finger-phalanx-proximal")];
  const Eigen::Vector3d wrist = mesh.T_mesh_joint[kWristJoint].translation();
  const Eigen::Vector3d index = mesh.T_mesh_joint[joint_index("index-finger-phalanx-proximal")].translation();
  const Eigen::Vector3d little = mesh.T_mesh_joint[joint_index("pinky-finger-phalanx-proximal")].translation();
  Eigen::Isometry3d T_mesh_hand = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d z = (wrist - mcp.translation()).normalized();
  const Eigen::Vector3d y = z.cross(little - index).normalized();
  T_mesh_hand.linear() << y.cross(z), y, z;
  T_mesh_hand.translation() = 0.5 * (wrist + mcp.translation());
  return T_mesh_hand;
}

RiggedMesh transformed(const Eigen::Isometry3d& T, RiggedMesh mesh) {
  for (Eigen::Vector3d& p : mesh.vertices) p = T * p;
  for (Eigen::Isometry3d& joint : mesh.T_mesh_joint) joint = T * joint;
  return mesh;
}

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

std::string model_hash(const GlovedMesh& mesh, const JointPoses& T_hand_joint, Side side) {
  std::string bytes = side == Side::right ? "right" : "left";
  for (const Eigen::Vector3d& p : mesh.vertices) bytes.append(reinterpret_cast<const char*>(p.data()), 24);
  for (const Influence& i : mesh.influences) append(bytes, i);
  for (const Triangle& t : mesh.triangles) {
    append(bytes, t.vertices);
    append(bytes, t.label);
    append(bytes, t.patch);
  }
  for (const Eigen::Isometry3d& T : T_hand_joint) {
    bytes.append(reinterpret_cast<const char*>(T.matrix().data()), 16 * sizeof(double));
  }
  return hash_text(bytes);
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

HandModel HandModel::load(const std::string& mesh_path, Side side, const HandShape& shape) {
  RiggedMesh mesh = load_rigged_mesh(mesh_path);
  correct_mcp_centers(mesh);
  mesh = transformed(hand_frame(mesh).inverse(), mesh);
  mesh = reshaped(with_forearm(mesh, kForearmLength), shape);
  // A stretched hand has its origin midway between its own joints.
  mesh = transformed(hand_frame(mesh).inverse(), mesh);
  GlovedMesh glove = cut_patches(mesh, patch_scores(mesh, shape.patch_border_shift));

  HandModel model;
  model.side_ = side;
  model.shape_ = shape;
  JointPoses T_hand_joint;
  std::copy(mesh.T_mesh_joint.begin(), mesh.T_mesh_joint.end(), T_hand_joint.begin());
  model.hash_ = model_hash(glove, T_hand_joint, side);
  model.skeleton_ = Skeleton(T_hand_joint);
  for (int j = 0; j < kJointCount; ++j) model.T_joint_bind_[j] = T_hand_joint[j].inverse();
  model.bind_vertices_ = std::move(glove.vertices);
  model.influences_ = std::move(glove.influences);
  model.triangles_ = std::move(glove.triangles);
  if (side == Side::left) {
    for (Triangle& t : model.triangles_) std::swap(t.vertices[1], t.vertices[2]);
  }
  return model;
}

PosedHand HandModel::pose(const Posture& posture) const {
  PosedHand hand;
  hand.T_hand_joint = skeleton_.pose(posture);
  std::array<Eigen::Matrix<double, 3, 4>, kJointCount> skinning;
  for (int j = 0; j < kJointCount; ++j) {
    skinning[j] = (hand.T_hand_joint[j] * T_joint_bind_[j]).matrix().topRows<3>();
  }
  hand.vertices.reserve(bind_vertices_.size());
  for (size_t v = 0; v < bind_vertices_.size(); ++v) {
    const Influence& influence = influences_[v];
    Eigen::Matrix<double, 3, 4> blended = skinning[influence.joint[0]] * double{influence.weight[0]};
    for (int i = 1; i < 4 && influence.weight[i] > 0; ++i) {
      blended += skinning[influence.joint[i]] * double{influence.weight[i]};
    }
    hand.vertices.push_back((blended * bind_vertices_[v].homogeneous()).cast<float>());
  }
  if (side_ == Side::left) {
    const Eigen::DiagonalMatrix<double, 3> mirror(-1, 1, 1);
    for (Eigen::Vector3f& p : hand.vertices) p.x() = -p.x();
    for (Eigen::Isometry3d& T : hand.T_hand_joint) {
      T.linear() = mirror * T.linear() * mirror;
      T.translation().x() *= -1;
    }
  }
  return hand;
}

}  // namespace glovebench
