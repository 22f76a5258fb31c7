#include "core/hand/hand_model.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/image.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

const HandModel& right_hand() {
  static const HandModel model = HandModel::load(build_paths::hand_mesh());
  return model;
}

Eigen::Vector3d joint_position(const PosedHand& hand, const char* name) {
  return hand.T_hand_joint[joint_index(name)].translation();
}

void expect_closed(const HandModel& model) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Triangle& t : model.triangles()) {
    for (int i = 0; i < 3; ++i) ++edges[{t.vertices[i], t.vertices[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << "edge used twice in one direction";
    ASSERT_TRUE(edges.contains({edge.second, edge.first})) << "open edge";
  }
}

double volume(const HandModel& model, const PosedHand& hand) {
  double sum = 0;
  for (const Triangle& t : model.triangles()) {
    const auto p = [&](int i) { return hand.vertices[t.vertices[i]].cast<double>().eval(); };
    sum += p(0).dot(p(1).cross(p(2))) / 6;
  }
  return sum;
}

TEST(HandModel, is_closed_after_cutting_for_both_sides_and_subjects) {
  for (const Side side : {Side::right, Side::left}) {
    for (const HandShape& shape : {HandShape{}, second_subject()}) {
      const HandModel model = HandModel::load(build_paths::hand_mesh(), side, shape);
      expect_closed(model);
      // Outward orientation; a hand with 6 cm of forearm holds 0.2 to 0.6 litres.
      const double litres = 1000 * volume(model, model.pose(Posture::Zero()));
      EXPECT_GT(litres, 0.2);
      EXPECT_LT(litres, 0.6);
    }
  }
}

/// Sizes that vary by 8%, any shift and heights, few votes.
HandShape drawn_shape(uint64_t seed) {
  RandomStream random(seed, "shape", 0, "sizes");
  HandShape shape;
  for (double& size : shape.sizes) size = std::clamp(1 + 0.08 * random.normal(), 0.5, 1.6);
  shape.patch_border_shift = random.uniform(-kMostBorderShift, kMostBorderShift);
  for (uint32_t v = 0; v < kRiggedMeshVertices; ++v) {
    shape.heights.push_back(random.uniform(-kMostHeight, kMostHeight));
    for (int vote = 0; vote < 3; ++vote)
      shape.patch_votes.push_back(
          {v, static_cast<uint8_t>(random.index(kPatchCount)), static_cast<int>(1 + random.index(2))});
  }
  return shape;
}

TEST(HandModel, is_closed_whatever_its_sizes_and_borders) {
  for (uint64_t seed = 1; seed <= 40; ++seed)
    expect_closed(HandModel::load(build_paths::hand_mesh(), Side::right, drawn_shape(seed)));
}

TEST(HandModel, is_closed_where_patches_have_as_many_votes) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "shape", 0, "votes");
    HandShape shape;
    for (const uint8_t patch : {kThumbProximal, kThumbDistal, kIndexProximal})
      for (uint32_t v = 0; v < kRiggedMeshVertices; ++v)
        shape.patch_votes.push_back({v, patch, 40 * static_cast<int>(1 + random.index(7))});
    expect_closed(HandModel::load(build_paths::hand_mesh(), Side::right, shape));
  }
}

/// How many parts a patch has that share no vertex.
int parts_of(const HandModel& model, int patch) {
  std::map<uint32_t, uint32_t> above;
  const auto top = [&](uint32_t vertex) {
    while (above.try_emplace(vertex, vertex).first->second != vertex) vertex = above[vertex];
    return vertex;
  };
  for (const Triangle& t : model.triangles())
    if (t.patch == patch)
      for (int i = 1; i < 3; ++i) above[top(t.vertices[i])] = top(t.vertices[0]);
  return static_cast<int>(std::ranges::count_if(above, [](const auto& link) { return link.first == link.second; }));
}

TEST(HandModel, shifted_borders_leave_patches_in_their_places) {
  for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    HandShape shape;
    shape.patch_border_shift = share * kMostBorderShift;
    const HandModel model = HandModel::load(build_paths::hand_mesh(), Side::right, shape);
    for (int patch = 0; patch < kPatchCount; ++patch)
      EXPECT_THAT(parts_of(model, patch), testing::AllOf(testing::Ge(1), testing::Le(patch == kPalmRadial ? 2 : 1)))
          << "patch " << patch << ", " << share;
  }
}

TEST(HandModel, cutting_adds_no_surface_and_loses_none) {
  const RiggedMesh mesh = load_rigged_mesh(build_paths::hand_mesh());
  std::vector<PatchScores> scores = patch_scores(mesh, 0);
  const GlovedMesh cut = cut_patches(mesh, scores);
  const auto area = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return 0.5 * (b - a).cross(c - a).norm();
  };
  double before = 0, after = 0;
  for (const auto& t : mesh.triangles) {
    before += area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  }
  for (const Triangle& t : cut.triangles) {
    after += area(cut.vertices[t.vertices[0]], cut.vertices[t.vertices[1]], cut.vertices[t.vertices[2]]);
  }
  EXPECT_NEAR(after, before, 1e-12);
  EXPECT_GT(cut.triangles.size(), mesh.triangles.size());
}

TEST(HandModel, has_twenty_patches_two_of_each_color) {
  std::map<int, int> triangles_of;
  for (const Triangle& t : right_hand().triangles()) {
    ++triangles_of[t.patch];
    EXPECT_EQ(t.label, patch_labels()[t.patch]);
  }
  EXPECT_EQ(triangles_of.size(), static_cast<size_t>(kPatchCount));
  std::map<int, int> patches_of;
  for (const uint8_t label : patch_labels()) ++patches_of[label];
  EXPECT_EQ(patches_of.size(), static_cast<size_t>(kColorCount));
  for (const auto& [label, count] : patches_of) EXPECT_EQ(count, 2) << int{label};
}

TEST(HandModel, is_rooted_at_the_palm) {
  const PosedHand hand = right_hand().pose(Posture::Zero());
  const Eigen::Vector3d wrist = joint_position(hand, "wrist");
  const Eigen::Vector3d mcp = joint_position(hand, "middle-finger-phalanx-proximal");
  EXPECT_LT((wrist + mcp).norm(), 1e-12);
  EXPECT_NEAR(wrist.x(), 0, 1e-12);
  EXPECT_NEAR(wrist.y(), 0, 1e-12);
  EXPECT_GT(wrist.z(), 0.03);
  // The right thumb is on the left when the back of the hand is seen with the fingers up.
  EXPECT_LT(joint_position(hand, "thumb-tip").x(), -0.02);
  EXPECT_GT(joint_position(hand, "pinky-finger-tip").x(), 0.02);
}

TEST(HandModel, follows_hand_computed_kinematics) {
  const PosedHand zero = right_hand().pose(Posture::Zero());
  const Eigen::Vector3d mcp = joint_position(zero, "index-finger-phalanx-proximal");
  const Eigen::Vector3d pip = joint_position(zero, "index-finger-phalanx-intermediate");
  const Eigen::Vector3d bone = pip - mcp;
  EXPECT_NEAR(bone.norm(), 0.0379, 1e-9);  // the corrected length

  // 90 degrees of MCP flexion: what pointed to -z points to -y (palmar), x stays.
  Posture flexed = Posture::Zero();
  flexed[kIndexMcpFlexion] = radians_from_degrees(90);
  const Eigen::Vector3d bent = joint_position(right_hand().pose(flexed), "index-finger-phalanx-intermediate") - mcp;
  EXPECT_LT((bent - Eigen::Vector3d(bone.x(), bone.z(), -bone.y())).norm(), 1e-12);
  EXPECT_LT(bent.y(), -0.03);

  // 30 degrees of abduction turn towards the thumb (-x): (x, y, z) -> (cx + sz, y, -sx + cz).
  Posture abducted = Posture::Zero();
  abducted[kIndexMcpAbduction] = radians_from_degrees(30);
  const Eigen::Vector3d turned =
      joint_position(right_hand().pose(abducted), "index-finger-phalanx-intermediate") - mcp;
  const double c = std::cos(radians_from_degrees(30)), s = 0.5;
  EXPECT_LT((turned - Eigen::Vector3d(c * bone.x() + s * bone.z(), bone.y(), -s * bone.x() + c * bone.z())).norm(),
            1e-12);
  EXPECT_LT(turned.x(), -0.015);

  // Abduction first: flexion bends about the abducted axis, so 90 degrees of it end at -y whatever the abduction.
  Posture both = flexed;
  both[kIndexMcpAbduction] = radians_from_degrees(30);
  const Eigen::Vector3d combined =
      joint_position(right_hand().pose(both), "index-finger-phalanx-intermediate") - mcp;
  EXPECT_NEAR(combined.y(), bent.y(), 1e-12);
}

TEST(HandModel, each_axis_is_the_derivative_by_its_angle) {
  const Skeleton& skeleton = right_hand().skeleton();
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) posture[a] = 0.1 + 0.05 * (a % 7);
  const std::array<Eigen::Vector3d, kAngleCount> axes = skeleton.axes(skeleton.pose(posture));
  constexpr double step = 1e-5;
  for (int a = 0; a < kAngleCount; ++a) {
    Posture less = posture, more = posture;
    less[a] -= step;
    more[a] += step;
    const int joint = joint_of_angle(a);
    const Eigen::AngleAxisd turn(skeleton.pose(more)[joint].linear() *
                                 skeleton.pose(less)[joint].linear().transpose());
    // Central differences: the error is of the order of step^2, and of rounding / step.
    EXPECT_LT((turn.axis() * turn.angle() / (2 * step) - axes[a]).norm(), 1e-8) << angle_infos()[a].name;
  }
}

TEST(HandModel, wrist_angles_move_only_forearm_and_cuff) {
  Posture posture = Posture::Zero();
  const PosedHand straight = right_hand().pose(posture);
  posture[kWristFlexion] = radians_from_degrees(40);
  const PosedHand flexed = right_hand().pose(posture);
  for (int j = 0; j < kForearmJoint; ++j) {
    EXPECT_TRUE(flexed.T_hand_joint[j].isApprox(straight.T_hand_joint[j], 0)) << joint_name(j);
  }
  // Flexing the wrist brings palm and forearm together: the forearm's end (+z) drops to the palmar side (-y).
  const Eigen::Vector3d end(0, 0, 0.05);
  EXPECT_LT((flexed.T_hand_joint[kForearmJoint] * end).y(), -0.02);
}

TEST(HandModel, left_hand_is_the_mirror_image) {
  const HandModel left = HandModel::load(build_paths::hand_mesh(), Side::left);
  Posture posture = Posture::Zero();
  posture[kThumbCmcAbduction] = 0.4;
  posture[kIndexMcpAbduction] = 0.2;
  posture[kRingPipFlexion] = 1.0;
  const PosedHand r = right_hand().pose(posture), l = left.pose(posture);
  ASSERT_EQ(r.vertices.size(), l.vertices.size());
  for (size_t v = 0; v < r.vertices.size(); ++v) {
    ASSERT_EQ(l.vertices[v], Eigen::Vector3f(-r.vertices[v].x(), r.vertices[v].y(), r.vertices[v].z()));
  }
}

TEST(HandModel, each_angle_moves_its_patches_and_no_other) {
  const HandModel& model = right_hand();
  const PosedHand zero = model.pose(Posture::Zero());
  for (int a = 0; a < kAngleCount; ++a) {
    Posture posture = Posture::Zero();
    posture[a] = radians_from_degrees(20);
    const PosedHand moved = model.pose(posture);
    std::map<int, std::pair<double, int>> travel;  // patch -> sum, count
    for (const Triangle& t : model.triangles()) {
      for (const uint32_t v : t.vertices) {
        travel[t.patch].first += (moved.vertices[v] - zero.vertices[v]).norm();
        ++travel[t.patch].second;
      }
    }
    for (const auto& [patch, sum] : travel) {
      const double mean = sum.first / sum.second;
      const bool named = patches_moved()[a] >> patch & 1;
      // Blended weights at the borders move a neighbor a little; 20 degrees move the own patch by millimetres.
      if (named) {
        EXPECT_GT(mean, 0.0006) << angle_infos()[a].name << " patch " << patch;
      }
      if (!named) {
        EXPECT_LT(mean, 0.0022) << angle_infos()[a].name << " patch " << patch;
      }
    }
  }
}

TEST(HandModel, its_hash_does_not_depend_on_the_instruction_set) {
  // It names the databases and the baselines. Compiled with any -march it is this one; change it with the hand.
  EXPECT_EQ(right_hand().hash(), "e197462616f76a361875a07357e5de64");
}

TEST(HandModel, second_subject_is_five_percent_larger_with_other_segments) {
  const HandModel other = HandModel::load(build_paths::hand_mesh(), Side::right, second_subject());
  const PosedHand a = right_hand().pose(Posture::Zero()), b = other.pose(Posture::Zero());
  const auto length = [](const PosedHand& hand, int from, int to) {
    return (hand.T_hand_joint[from].translation() - hand.T_hand_joint[to].translation()).norm();
  };
  EXPECT_NEAR(length(b, kWristJoint, 11) / length(a, kWristJoint, 11), 1.05, 1e-9);
  // Index proximal is 4% shorter before the scale; its offset lies along the bone within a few degrees.
  EXPECT_NEAR(length(b, 6, 7) / length(a, 6, 7), 1.05 * 0.96, 0.003);
  EXPECT_NE(other.hash(), right_hand().hash());
}

TEST(HandModel, refuses_a_missing_or_altered_mesh) {
  EXPECT_THROW(HandModel::load("no-such-file.glb"), Error);
  const std::string path = test_folder() + "/altered.glb";
  {
    std::ifstream in(build_paths::hand_mesh(), std::ios::binary);
    std::string content((std::istreambuf_iterator<char>(in)), {});
    content[5000] ^= 1;
    std::ofstream(path, std::ios::binary) << content;
  }
  EXPECT_THAT(thrown_by([&] { HandModel::load(path); }), testing::HasSubstr("checksum"));
}

/// How far the predicted motion of each vertex is from the difference of two poses, m a radian.
struct Deviation {
  double mean = 0;
  double largest_of_rigid = 0;  ///< of vertices that follow the angle wholly or not at all
};

Deviation deviation(const HandModel& model, const Posture& posture, int angle) {
  constexpr double kTurn = 0.01;
  Posture less = posture, more = posture;
  less[angle] -= kTurn / 2;
  more[angle] += kTurn / 2;
  const PosedHand before = model.pose(less), hand = model.pose(posture), after = model.pose(more);
  const Screw screw = angle_screws(model, hand)[angle];
  const std::vector<BodyShares> shares = body_shares(model);
  Deviation result;
  for (size_t v = 0; v < hand.vertices.size(); ++v) {
    const Eigen::Vector3d q = hand.vertices[v].cast<double>();
    const Eigen::Vector3d moved = (after.vertices[v] - before.vertices[v]).cast<double>() / kTurn;
    const double share = angle_shares(shares[v])[angle];
    const double off = (share * (screw.axis.cross(q) + screw.moment) - moved).norm();
    result.mean += off / static_cast<double>(hand.vertices.size());
    if (share < 1e-6 || share > 1 - 1e-6) result.largest_of_rigid = std::max(result.largest_of_rigid, off);
  }
  return result;
}

Posture some_posture() {
  RandomStream random(1, "hand motion", 0, "posture");
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) posture[a] = random.uniform(0.1, 0.7);
  return posture;
}

TEST(HandMotion, predicts_how_each_angle_moves_the_surface) {
  for (const Side side : {Side::right, Side::left}) {
    const HandModel model = HandModel::load(build_paths::hand_mesh(), side);
    for (int a = 0; a < kAngleCount; ++a) {
      const Deviation off = deviation(model, some_posture(), a);
      // Vertices are floats: 1e-8 m over a turn of 0.01, and a blended vertex follows its mean joint only nearly.
      EXPECT_LT(off.largest_of_rigid, 1e-5) << angle_infos()[a].name;
      EXPECT_LT(off.mean, 5e-4) << angle_infos()[a].name;
    }
  }
}

TEST(HandMotion, shares_of_the_bodies_sum_to_one) {
  EXPECT_EQ(angles_of_body(0), 0u);
  for (const BodyShares& shares : body_shares(HandModel::load(build_paths::hand_mesh()))) {
    float sum = 0;
    for (const float share : shares) sum += share;
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

}  // namespace
}  // namespace glovebench
