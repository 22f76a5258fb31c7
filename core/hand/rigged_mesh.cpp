#include "core/hand/rigged_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <map>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/hand/skeleton.h"

namespace glovebench {
namespace {

constexpr uint64_t kLargestMesh = uint64_t{16} << 20;  // bytes

Eigen::Isometry3d isometry(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  Eigen::Isometry3d T;
  T.linear() = Eigen::Quaterniond(matrix.topLeftCorner<3, 3>()).normalized().toRotationMatrix();
  T.translation() = matrix.topRightCorner<3, 1>();
  T.makeAffine();
  return T;
}

Eigen::Isometry3d node_pose(const aiNode* node) {
  aiMatrix4x4 matrix;
  for (; node != nullptr; node = node->mParent) matrix = node->mTransformation * matrix;
  return isometry(matrix);
}

/// Index of each vertex among the distinct positions, in order of first appearance.
std::vector<uint32_t> weld(const aiMesh& mesh) {
  std::map<std::array<float, 3>, uint32_t> index_of;
  std::vector<uint32_t> welded(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    welded[v] = index_of.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(index_of.size())).first->second;
  }
  return welded;
}

void add_influence(Influence& influence, int joint, float weight) {
  for (int i = 0; i < 4; ++i) {
    if (influence.weight[i] > 0 && influence.joint[i] == joint) return;  // the same vertex, welded
    if (influence.weight[i] > 0) continue;
    influence.joint[i] = static_cast<uint8_t>(joint);
    influence.weight[i] = weight;
    return;
  }
  check(false, "a vertex has at most four influences");
}

RiggedMesh convert(const aiScene& scene) {
  const aiMesh& mesh = *scene.mMeshes[0];
  const std::vector<uint32_t> welded = weld(mesh);
  const size_t count = *std::max_element(welded.begin(), welded.end()) + 1;

  RiggedMesh result;
  result.vertices.resize(count);
  result.influences.resize(count);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    result.vertices[welded[v]] = Eigen::Vector3d(p.x, p.y, p.z);
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    check(face.mNumIndices == 3, "the mesh consists of triangles");
    result.triangles.push_back({welded[face.mIndices[0]], welded[face.mIndices[1]], welded[face.mIndices[2]]});
  }
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const int joint = joint_index(bone.mName.C_Str());
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
      if (bone.mWeights[w].mWeight <= 0) continue;
      add_influence(result.influences[welded[bone.mWeights[w].mVertexId]], joint, bone.mWeights[w].mWeight);
    }
  }
  return result;
}

constexpr double kBlend = 0.012;     // m on either side of the wrist joint
constexpr double kRingStep = 0.012;  // m

bool is_cap(const RiggedMesh& mesh, const std::array<uint32_t, 3>& t, double z_wrist) {
  const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  return normal.z() > 0.7 && std::min({a.z(), b.z(), c.z()}) > z_wrist;
}

/// The opening's vertices in the order in which the removed triangles' side lists them.
std::vector<uint32_t> boundary_loop(const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  std::map<uint32_t, uint32_t> next;  // against the direction of the triangle that has the edge
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first})) next[edge.second] = edge.first;
  check(!next.empty(), "removing the cap opens the mesh");
  std::vector<uint32_t> loop;
  uint32_t v = next.begin()->first;
  do {
    loop.push_back(v);
    v = next.at(v);
  } while (v != loop.front());
  check(loop.size() == next.size(), "the opening is one loop");
  return loop;
}

/// Adds a ring of vertices at depth `z` (at least that of the ring before it) and joins it to that ring.
std::vector<uint32_t> extrude(RiggedMesh& mesh, const std::vector<uint32_t>& ring, double z) {
  std::vector<uint32_t> added;
  for (const uint32_t v : ring) {
    Eigen::Vector3d p = mesh.vertices[v];
    p.z() = z;
    added.push_back(static_cast<uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(p);
    mesh.influences.push_back(mesh.influences[v]);
  }
  for (size_t i = 0; i < ring.size(); ++i) {
    const size_t k = (i + 1) % ring.size();
    mesh.triangles.push_back({ring[i], ring[k], added[k]});
    mesh.triangles.push_back({ring[i], added[k], added[i]});
  }
  return added;
}

void close_ring(RiggedMesh& mesh, const std::vector<uint32_t>& ring) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const uint32_t v : ring) center += mesh.vertices[v] / static_cast<double>(ring.size());
  const auto middle = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(center);
  mesh.influences.push_back(mesh.influences[ring.front()]);
  for (size_t i = 0; i < ring.size(); ++i) mesh.triangles.push_back({ring[i], ring[(i + 1) % ring.size()], middle});
}

Influence blended(const Influence& influence, double forearm_share) {
  if (forearm_share <= 0) return influence;
  // The forearm takes the slot of the weakest influence.
  int weakest = 0;
  for (int i = 1; i < 4; ++i)
    if (influence.weight[i] < influence.weight[weakest]) weakest = i;
  Influence result = influence;
  result.weight[weakest] = 0;
  const float rest = result.weight[0] + result.weight[1] + result.weight[2] + result.weight[3];
  check(rest > 0, "a vertex has an influence");
  for (float& w : result.weight) w *= static_cast<float>(1 - forearm_share) / rest;
  result.joint[weakest] = kForearmJoint;
  result.weight[weakest] = static_cast<float>(forearm_share);
  return result;
}

}  // namespace

float Influence::weight_of(int j) const {
  float sum = 0;
  for (int i = 0; i < 4; ++i)
    if (joint[i] == j) sum += weight[i];
  return sum;
}

RiggedMesh load_rigged_mesh(const std::string& path) {
  const std::string content = read_file(path, kLargestMesh);
  const std::string hash = hash_text(content);
  if (hash != kRiggedMeshHash)
    throw Error(path, "checksum", hash, std::string(kRiggedMeshHash) + " (generic-hand/right.glb; run ci/setup)");
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TEXCOORDS | aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFileFromMemory(
      content.data(), content.size(), aiProcess_JoinIdenticalVertices | aiProcess_RemoveComponent, "glb");
  if (scene == nullptr || scene->mNumMeshes != 1)
    throw Error(path, "mesh", importer.GetErrorString(), "one rigged mesh in glTF binary format");
  RiggedMesh mesh = convert(*scene);
  for (int j = 0; j < kForearmJoint; ++j) {
    const aiNode* node = scene->mRootNode->FindNode(joint_name(j).c_str());
    if (node == nullptr) throw Error(path, "joint " + joint_name(j), "nothing", "a node of that name");
    mesh.T_mesh_joint.push_back(node_pose(node));
  }
  return mesh;
}

RiggedMesh with_forearm(const RiggedMesh& hand, double length) {
  const double z_wrist = hand.T_mesh_joint[kWristJoint].translation().z();
  RiggedMesh mesh = hand;
  mesh.triangles.clear();
  for (const auto& t : hand.triangles)
    if (!is_cap(hand, t, z_wrist)) mesh.triangles.push_back(t);
  const std::vector<uint32_t> opening = boundary_loop(mesh.triangles);

  double z_opening = z_wrist;
  for (const uint32_t v : opening) z_opening = std::max(z_opening, mesh.vertices[v].z());
  std::vector<uint32_t> ring = opening;
  for (double z = z_opening + 0.002; z < z_wrist + length; z += kRingStep) ring = extrude(mesh, ring, z);
  close_ring(mesh, extrude(mesh, ring, z_wrist + length));

  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double share = (mesh.vertices[v].z() - (z_wrist - kBlend)) / (2 * kBlend);
    mesh.influences[v] = blended(mesh.influences[v], std::clamp(share, 0.0, 1.0));
  }
  Eigen::Isometry3d T_hand_forearm = Eigen::Isometry3d::Identity();
  T_hand_forearm.translation() = hand.T_mesh_joint[kWristJoint].translation();
  mesh.T_mesh_joint.push_back(T_hand_forearm);
  return mesh;
}

std::vector<Eigen::Vector3d> vertex_normals(const RiggedMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d normal =
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    for (const uint32_t v : t) normals[v] += normal;
  }
  for (Eigen::Vector3d& n : normals)
    if (n.norm() > 0) n.normalize();
  return normals;
}

}  // namespace glovebench
