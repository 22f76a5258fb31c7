#include "core/hand/rigged_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <map>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/hand/skeleton.h"

namespace glovebench {
namespace {

constexpr uint64_t kLargestMesh = uint64_t{16} << 20;  // bytes
constexpr const char* kMeshHash = "1e3af8c1f6637a9241aa2102f28a11bb";

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

}  // namespace

float Influence::weight_of(int j) const {
  float sum = 0;
  for (int i = 0; i < 4; ++i) {
    if (joint[i] == j) sum += weight[i];
  }
  return sum;
}

RiggedMesh load_rigged_mesh(const std::string& path) {
  const std::string content = read_file(path, kLargestMesh);
  const std::string hash = hash_text(content);
  if (hash != kMeshHash) {
    throw Error(path, "checksum", hash, std::string(kMeshHash) + " (generic-hand/right.glb; run ci/setup)");
  }
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TEXCOORDS | aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFileFromMemory(
      content.data(), content.size(), aiProcess_JoinIdenticalVertices | aiProcess_RemoveComponent, "glb");
  if (scene == nullptr || scene->mNumMeshes != 1) {
    throw Error(path, "mesh", importer.GetErrorString(), "one rigged mesh in glTF binary format");
  }
  RiggedMesh mesh = convert(*scene);
  for (int j = 0; j < kForearmJoint; ++j) {
    const aiNode* node = scene->mRootNode->FindNode(joint_name(j).c_str());
    if (node == nullptr) throw Error(path, "joint " + joint_name(j), "nothing", "a node of that name");
    mesh.T_mesh_joint.push_back(node_pose(node));
  }
  return mesh;
}

}  // namespace glovebench
