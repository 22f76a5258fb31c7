#include "render/subjects/capsule_hand.h"

#include <array>
#include <limits>

#include "core/base/hash.h"
#include "render/subjects/capsule_glove.h"
#include "render/subjects/capsule_skeleton.h"
#include "render/subjects/surface_net.h"

namespace glovebench::render {
namespace {

constexpr double kCell = 0.0025;           // m
constexpr double kForearmLength = 0.06;    // m past the wrist joint, as the tracker's mesh
constexpr double kCuffEdge = 0.0015;       // m: what is nearer to the cuff's flat end moves with the forearm alone
constexpr double kHem = 0.012;             // m of the cuff whose folds fade out
constexpr double kFollowSoftness = 0.004;  // m
constexpr float kLeastFollow = 0.02f;

/// How much farther than the surface a capsule may be at rest to be joined: all of it up to the first distance,
/// nothing beyond the second, m.
struct Reach {
  double full;
  double none;
};
constexpr Reach kPalmReach = {0.006, 0.016};
constexpr Reach kSegmentReach = {0.003, 0.006};

double fade_out(double distance, const Reach& reach) {
  const double x = std::clamp((distance - reach.full) / (reach.none - reach.full), 0.0, 1.0);
  return 1 - x * x * (3 - 2 * x);
}

Eigen::AlignedBox3d box_of(const std::vector<Capsule>& capsules, double z_end) {
  constexpr double kMargin = 0.010;  // m
  Eigen::AlignedBox3d box;
  for (const Capsule& c : capsules) {
    for (const auto& [p, radius] : {std::pair(c.a, c.radius_a), std::pair(c.b, c.radius_b)}) {
      const Eigen::Vector3d around = Eigen::Vector3d::Constant(radius + kMargin);
      box.extend(p - around);
      box.extend(p + around);
    }
  }
  box.max().z() = z_end + kMargin;
  return box;
}

/// Where on a capsule's axis the ball that is nearest to a point has its center: 0 at end a, 1 at end b.
double along_capsule(const Capsule& capsule, const Eigen::Vector3d& p) {
  const Eigen::Vector3d axis = capsule.b - capsule.a;
  return std::clamp((p - capsule.a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
}

}  // namespace

CapsuleHand::CapsuleHand(uint64_t seed, Side side, const Skeleton& definition)
    : side_(side),
      dimensions_(draw_dimensions(seed)),
      skeleton_(make_skeleton(dimensions_, definition, seed)),
      capsules_(make_capsules(dimensions_, skeleton_)) {
  polygonize(seed);
  hash_ = make_hash();
  if (side_ == Side::left)
    for (Triangle& t : triangles_) std::swap(t.vertices[1], t.vertices[2]);
}

void CapsuleHand::polygonize(uint64_t seed) {
  const JointPoses T_hand_joint = skeleton_.pose(rest_posture());
  for (int j = 0; j < kJointCount; ++j) T_joint_rest_[j] = T_hand_joint[j].inverse();
  const std::vector<Capsule> rest = place_capsules(capsules_, T_hand_joint, rest_posture());
  std::vector<UnionPart> all;
  for (size_t c = 0; c < capsules_.size(); ++c) all.push_back({static_cast<uint8_t>(c), capsules_[c].joining, 1});
  const double z_end = T_hand_joint[kForearmJoint].translation().z() + kForearmLength;
  const auto field = [&](const Eigen::Vector3d& p) {
    return std::max(smooth_union(rest, all, p).value, p.z() - z_end);
  };
  const auto is_end = [z_end](const Eigen::Vector3d& p) { return p.z() > z_end - kCuffEdge; };

  SurfaceNet net = polygonize_field(field, box_of(rest, z_end), kCell);
  const CapsuleGlove glove(capsules_, rest, T_hand_joint, seed);
  RiggedMesh mesh;
  mesh.triangles = std::move(net.triangles);
  std::vector<PatchScores> scores;
  for (const Eigen::Vector3d& vertex : net.vertices) {
    const Eigen::Vector3d p = is_end(vertex) ? vertex : project_to_level(rest, all, 0, vertex);
    mesh.vertices.push_back(p);
    mesh.influences.push_back({{}, {1, 0, 0, 0}});  // cutting asks for some; they are not used
    scores.push_back(glove.scores(p, smooth_union(rest, all, p).gradient.normalized()));
  }
  GlovedMesh cut = cut_patches(mesh, scores);
  triangles_ = std::move(cut.triangles);
  rest_ = std::move(cut.vertices);
  levels_ = glove.folds(rest_);
  for (size_t v = 0; v < rest_.size(); ++v) {
    join_capsules(rest, rest_[v]);
    const double hem = fade_out(rest_[v].z() - z_end, {-kHem, -kHem / 2});
    levels_[v] = is_end(rest_[v]) ? std::numeric_limits<double>::quiet_NaN() : kGloveThickness + hem * levels_[v];
  }
  first_part_.push_back(static_cast<uint32_t>(parts_.size()));
  first_follow_.push_back(static_cast<uint32_t>(follows_.size()));
}

/// Adds the parts and the joints of a vertex at rest.
void CapsuleHand::join_capsules(const std::vector<Capsule>& rest, const Eigen::Vector3d& p) {
  first_part_.push_back(static_cast<uint32_t>(parts_.size()));
  first_follow_.push_back(static_cast<uint32_t>(follows_.size()));
  std::vector<double> distances;
  for (const Capsule& capsule : rest) distances.push_back(distance_to(capsule, p).value);
  const double nearest = *std::min_element(distances.begin(), distances.end());
  std::array<double, kJointCount> follow{};
  double sum = 0;
  for (size_t c = 0; c < rest.size(); ++c) {
    const Joining joining = capsules_[c].joining;
    const double farther = distances[c] - nearest;
    const double share = fade_out(farther, joining == Joining::palm ? kPalmReach : kSegmentReach);
    if (share > 0) parts_.push_back({static_cast<uint8_t>(c), joining, static_cast<float>(share)});
    const double weight = share * std::exp(-farther / kFollowSoftness);
    const double along = along_capsule(rest[c], p);
    follow[capsules_[c].a.joint] += weight * (1 - along);
    follow[capsules_[c].b.joint] += weight * along;
    sum += weight;
  }
  double kept = 0;
  for (const double f : follow) kept += f / sum >= kLeastFollow ? f : 0;
  for (int j = 0; j < kJointCount; ++j)
    if (follow[j] / sum >= kLeastFollow)
      follows_.push_back({static_cast<uint8_t>(j), static_cast<float>(follow[j] / kept)});
}

Posture CapsuleHand::rest_posture() {
  return posture_from_degrees({0, 0, 35, 0, 5, 5, 12, 5, 5, 5, 3, 5, 5, 5, -8, 5, 5, 5, -20, 5, 5, 5});
}

PosedHand CapsuleHand::pose(const Posture& posture) const {
  PosedHand hand;
  hand.T_hand_joint = skeleton_.pose(posture);
  const std::vector<Capsule> placed = place_capsules(capsules_, hand.T_hand_joint, posture);
  std::array<Eigen::Matrix<double, 3, 4>, kJointCount> moves;
  for (int j = 0; j < kJointCount; ++j) moves[j] = (hand.T_hand_joint[j] * T_joint_rest_[j]).matrix().topRows<3>();
  hand.vertices.reserve(rest_.size());
  for (size_t v = 0; v < rest_.size(); ++v) {
    Eigen::Matrix<double, 3, 4> move = Eigen::Matrix<double, 3, 4>::Zero();
    for (uint32_t f = first_follow_[v]; f < first_follow_[v + 1]; ++f)
      move += double{follows_[f].weight} * moves[follows_[f].joint];
    Eigen::Vector3d p = move * rest_[v].homogeneous();
    if (!std::isnan(levels_[v])) p = project_to_level(placed, parts_of(v), levels_[v], p);
    hand.vertices.push_back(p.cast<float>());
  }
  if (side_ == Side::left) {
    for (Eigen::Vector3f& p : hand.vertices) p.x() = -p.x();
    hand.T_hand_joint = joints(posture);
  }
  return hand;
}

JointPoses CapsuleHand::joints(const Posture& posture) const {
  JointPoses T_hand_joint = skeleton_.pose(posture);
  if (side_ == Side::right) return T_hand_joint;
  const Eigen::DiagonalMatrix<double, 3> mirror(-1, 1, 1);
  for (Eigen::Isometry3d& T : T_hand_joint) {
    T.linear() = mirror * T.linear() * mirror;
    T.translation().x() *= -1;
  }
  return T_hand_joint;
}

FieldSample CapsuleHand::field_at(size_t v, const std::vector<Capsule>& placed, const Eigen::Vector3d& p) const {
  return smooth_union(placed, parts_of(v), p);
}

std::string CapsuleHand::make_hash() const {
  std::string bytes(to_string(side_));
  const auto append = [&bytes](const void* data, size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  for (const Eigen::Vector3d& p : rest_) append(p.data(), 3 * sizeof(double));
  append(levels_.data(), levels_.size() * sizeof(double));
  for (const Triangle& t : triangles_) {
    append(t.vertices.data(), sizeof(t.vertices));
    append(&t.patch, 1);
  }
  for (const Eigen::Isometry3d& T : skeleton_.pose(Posture::Zero())) append(T.matrix().data(), 16 * sizeof(double));
  return hash_text(bytes);
}

}  // namespace glovebench::render
