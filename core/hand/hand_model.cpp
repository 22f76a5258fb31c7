#include "core/hand/hand_model.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/hand/rigged_mesh.h"
#include "core/hand/skeleton.h"

namespace glovebench {
namespace {

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

RiggedMesh in_hand_frame(RiggedMesh mesh) {
  const Eigen::Isometry3d T_hand_mesh = hand_frame(mesh).inverse();
  for (Eigen::Vector3d& p : mesh.vertices) p = T_hand_mesh * p;
  for (Eigen::Isometry3d& joint : mesh.T_mesh_joint) joint = T_hand_mesh * joint;
  return mesh;
}

/// The mesh of a person, hand frame.
RiggedMesh shaped_mesh(const std::string& path, const HandShape& shape) {
  RiggedMesh mesh = load_rigged_mesh(path);
  correct_mcp_centers(mesh);
  // A stretched hand has its origin midway between its own joints.
  return in_hand_frame(reshaped(with_forearm(in_hand_frame(mesh), kForearmLength), shape));
}

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// The mirror image of a left hand: the right hand that its skeleton speaks of, and back.
JointPoses mirrored(JointPoses poses) {
  const Eigen::DiagonalMatrix<double, 3> mirror(-1, 1, 1);
  for (Eigen::Isometry3d& T : poses) {
    T.linear() = mirror * T.linear() * mirror;
    T.translation().x() *= -1;
  }
  return poses;
}

/// The angles of a joint and of those it hangs on, as bits.
uint32_t angles_above(int joint) {
  uint32_t angles = 0;
  for (int a = 0; a < kAngleCount; ++a)
    for (int j = joint; j >= 0; j = joint_parents()[j])
      if (joint_of_angle(a) == j) angles |= uint32_t{1} << a;
  return angles;
}

/// Joints that the same angles move are one body.
struct Bodies {
  std::array<uint32_t, kBodyCount> angles{};
  std::array<uint8_t, kJointCount> of_joint{};
};

Bodies make_bodies() {
  Bodies bodies;
  int count = 1;
  for (int j = 0; j < kJointCount; ++j) {
    const auto known = bodies.angles.begin() + count;
    const auto body = std::find(bodies.angles.begin(), known, angles_above(j));
    if (body == known) {
      check(count < kBodyCount, "a hand has 17 bodies");
      bodies.angles[count++] = angles_above(j);
    }
    bodies.of_joint[j] = static_cast<uint8_t>(body - bodies.angles.begin());
  }
  check(count == kBodyCount, "a hand has 17 bodies");
  return bodies;
}

const Bodies& bodies_of_hand() {
  static const Bodies made = make_bodies();
  return made;
}

}  // namespace

HandModel::HandModel(Side side, HandShape shape, GlovedMesh glove, std::span<const Eigen::Isometry3d> T_hand_joint)
    : side_(side),
      shape_(std::move(shape)),
      influences_(std::move(glove.influences)),
      triangles_(std::move(glove.triangles)) {
  bind(std::move(glove.vertices), T_hand_joint);
  if (side == Side::left)
    for (Triangle& t : triangles_) std::swap(t.vertices[1], t.vertices[2]);
}

HandModel HandModel::load(const std::string& mesh_path, Side side, const HandShape& shape) {
  const RiggedMesh mesh = shaped_mesh(mesh_path, shape);
  std::vector<PatchScores> scores = patch_scores(mesh, shape.patch_border_shift);
  add_votes(scores, shape.patch_votes);
  return {side, shape, cut_patches(mesh, scores), mesh.T_mesh_joint};
}

HandModel HandModel::load_plain(const std::string& mesh_path, Side side, const HandShape& shape) {
  const RiggedMesh mesh = shaped_mesh(mesh_path, shape);
  GlovedMesh plain{mesh.vertices, mesh.influences, {}};
  for (const auto& vertices : mesh.triangles) plain.triangles.push_back({vertices, patch_labels()[0], 0});
  return {side, shape, std::move(plain), mesh.T_mesh_joint};
}

HandModel HandModel::stretched(const HandSizes& factors) const {
  RiggedMesh mesh{bind_vertices_, influences_, {}, {}};
  for (const Eigen::Isometry3d& T : T_joint_bind_) mesh.T_mesh_joint.push_back(T.inverse());
  mesh = in_hand_frame(reshaped(mesh, {.sizes = factors}));
  HandModel model = *this;
  for (int i = 0; i < kSizeCount; ++i) model.shape_.sizes[i] *= factors[i];
  model.bind(std::move(mesh.vertices), mesh.T_mesh_joint);
  return model;
}

void HandModel::bind(std::vector<Eigen::Vector3d> vertices, std::span<const Eigen::Isometry3d> T_hand_joint) {
  JointPoses joints;
  std::ranges::copy(T_hand_joint, joints.begin());
  skeleton_ = Skeleton(joints);
  for (int j = 0; j < kJointCount; ++j) T_joint_bind_[j] = joints[j].inverse();
  bind_vertices_ = std::move(vertices);
  hash_ = make_hash(joints);
}

std::string HandModel::make_hash(const JointPoses& T_hand_joint) const {
  std::string bytes{to_string(side_)};
  for (const Eigen::Vector3d& p : bind_vertices_) bytes.append(reinterpret_cast<const char*>(p.data()), 24);
  for (const Influence& i : influences_) append(bytes, i);
  for (const Triangle& t : triangles_) {
    append(bytes, t.vertices);
    append(bytes, t.label);
    append(bytes, t.patch);
  }
  for (const Eigen::Isometry3d& T : T_hand_joint)
    bytes.append(reinterpret_cast<const char*>(T.matrix().data()), 16 * sizeof(double));
  return hash_text(bytes);
}

PosedHand HandModel::pose(const Posture& posture) const {
  PosedHand hand;
  hand.T_hand_joint = skeleton_.pose(posture);
  // Whole matrices, although their last row is never used: their columns are whole vectors.
  std::array<Eigen::Matrix4d, kJointCount> skinning;
  for (int j = 0; j < kJointCount; ++j) skinning[j] = (hand.T_hand_joint[j] * T_joint_bind_[j]).matrix();
  hand.vertices.resize(bind_vertices_.size());
  for (size_t v = 0; v < bind_vertices_.size(); ++v) {
    const Influence& influence = influences_[v];
    Eigen::Matrix4d blended = skinning[influence.joint[0]] * double{influence.weight[0]};
    for (int i = 1; i < 4 && influence.weight[i] > 0; ++i)
      blended += skinning[influence.joint[i]] * double{influence.weight[i]};
    const Eigen::Vector3d& p = bind_vertices_[v];
    const Eigen::Vector4d posed =
        (blended.col(0) * p.x() + blended.col(1) * p.y()) + blended.col(2) * p.z() + blended.col(3);
    hand.vertices[v] = posed.head<3>().cast<float>();
  }
  if (side_ == Side::left) {
    for (Eigen::Vector3f& p : hand.vertices) p.x() = -p.x();
    hand.T_hand_joint = mirrored(hand.T_hand_joint);
  }
  return hand;
}

std::array<Screw, kAngleCount> angle_screws(const HandModel& model, const PosedHand& hand) {
  const bool is_left = model.side() == Side::left;
  const JointPoses right = is_left ? mirrored(hand.T_hand_joint) : hand.T_hand_joint;
  const std::array<Eigen::Vector3d, kAngleCount> axes = model.skeleton().axes(right);
  std::array<Screw, kAngleCount> screws;
  for (int a = 0; a < kAngleCount; ++a) {
    // A mirror turns the sense of a rotation around.
    const Eigen::Vector3d axis = is_left ? Eigen::Vector3d(axes[a].x(), -axes[a].y(), -axes[a].z()) : axes[a];
    const Eigen::Vector3d& origin = hand.T_hand_joint[joint_of_angle(a)].translation();
    screws[a] = {axis, origin.cross(axis)};
  }
  return screws;
}

uint32_t angles_of_body(int body) { return bodies_of_hand().angles.at(body); }

std::vector<BodyShares> body_shares(const HandModel& model) {
  std::vector<BodyShares> shares;
  shares.reserve(model.vertex_count());
  for (const Influence& influence : model.influences()) {
    BodyShares& share = shares.emplace_back();
    share.fill(0);
    for (int i = 0; i < 4; ++i) share[bodies_of_hand().of_joint[influence.joint[i]]] += influence.weight[i];
  }
  return shares;
}

AngleShares angle_shares(const BodyShares& shares) {
  AngleShares result = AngleShares::Zero();
  for (int body = 0; body < kBodyCount; ++body)
    for (int a = 0; a < kAngleCount; ++a)
      if (angles_of_body(body) >> a & 1) result[a] += shares[body];
  return result;
}

}  // namespace glovebench
