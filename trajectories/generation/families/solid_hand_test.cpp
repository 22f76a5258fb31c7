#include "trajectories/generation/families/solid_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "ci/build_paths.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/hand/hand_model.h"
#include "core/pose/closest_point.h"
#include "trajectories/generation/families/movement.h"

namespace glovebench::trajectories {
namespace {

const HandModel& solid_test_hand() {
  static const HandModel model = HandModel::load(build_paths::hand_mesh());
  return model;
}

double overlap_of(std::initializer_list<std::pair<Angle, double>> angles_deg) {
  Posture posture = Posture::Zero();
  for (const auto& [angle, degrees] : angles_deg) posture[angle] = radians_from_degrees(degrees);
  return deepest_overlap(solid_test_hand().skeleton(), posture);
}

TEST(SolidHand, straight_fingers_side_by_side_are_apart) {
  EXPECT_LT(overlap_of({{kThumbCmcAbduction, 20}}), kMostOverlap);
}

TEST(SolidHand, crossed_fingers_pierce_each_other) {
  EXPECT_GT(overlap_of({{kIndexMcpAbduction, -12}, {kMiddleMcpAbduction, 12}}), 2 * kMostOverlap);
  EXPECT_LT(overlap_of({{kIndexMcpAbduction, -12}, {kMiddleMcpAbduction, 12}, {kIndexMcpFlexion, 60}}),
            overlap_of({{kIndexMcpAbduction, -12}, {kMiddleMcpAbduction, 12}}))
      << "one lies before the other";
}

TEST(SolidHand, a_fingertip_that_bends_into_the_palm_pierces_it) {
  const auto bent = [](double mcp, double pip, double dip) {
    return overlap_of(
        {{kThumbCmcAbduction, 20}, {kMiddleMcpFlexion, mcp}, {kMiddlePipFlexion, pip}, {kMiddleDipFlexion, dip}});
  };
  EXPECT_LT(bent(60, 60, 40), kMostOverlap);
  EXPECT_GT(bent(100, 120, 40), 2 * kMostOverlap);
}

/// The finger that a vertex belongs to most; 5 is the palm with the forearm.
int finger_of(const Influence& influence) {
  const int joint = influence.joint[std::ranges::max_element(influence.weight) - influence.weight.begin()];
  if (joint == kWristJoint || joint == kForearmJoint) return 5;
  if (joint < 5) return 0;
  return (joint - 5) % 5 == 0 ? 5 : (joint - 5) / 5 + 1;
}

/// The mesh of one finger.
std::vector<Surface::Face> faces_of_finger(const PosedHand& hand, int finger) {
  std::vector<Surface::Face> faces;
  for (const Triangle& triangle : solid_test_hand().triangles()) {
    const auto& [a, b, c] = triangle.vertices;
    if (std::ranges::all_of(triangle.vertices,
                            [&](uint32_t v) { return finger_of(solid_test_hand().influences()[v]) == finger; }))
      faces.push_back({hand.vertices[a], hand.vertices[b], hand.vertices[c], 0});
  }
  return faces;
}

/// How often the surface goes round the point, also if it is open at one end (van Oosterom and Strackee 1983):
/// about 1 inside, about 0 outside.
double winding_number(const std::vector<Surface::Face>& faces, const Eigen::Vector3f& point) {
  double angle = 0;
  for (const Surface::Face& face : faces) {
    const Eigen::Vector3d a = (face.a - point).cast<double>(), b = (face.b - point).cast<double>(),
                          c = (face.c - point).cast<double>();
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// How deep vertices of one finger lie in the mesh of another, m: shares no code with `deepest_overlap`.
double deepest_in_mesh(const Posture& posture) {
  const PosedHand hand = solid_test_hand().pose(posture);
  double deepest = 0;
  for (int finger = 0; finger < 5; ++finger) {
    const std::vector<Surface::Face> faces = faces_of_finger(hand, finger);
    Eigen::AlignedBox3f box;
    for (const Surface::Face& face : faces) box.extend(face.a).extend(face.b).extend(face.c);
    for (size_t v = 0; v < hand.vertices.size(); ++v) {
      const int own = finger_of(solid_test_hand().influences()[v]);
      if (own == finger || own == 5 || !box.contains(hand.vertices[v])) continue;
      double distance = 1;
      for (const Surface::Face& face : faces)
        distance =
            std::min<double>(distance, (closest_on_triangle(hand.vertices[v], face) - hand.vertices[v]).norm());
      constexpr double reach = 0.02;  // no finger is thicker
      if (distance > deepest && distance < reach && winding_number(faces, hand.vertices[v]) > 0.5)
        deepest = distance;
    }
  }
  return deepest;
}

TEST(SolidHandLong, agrees_with_the_mesh) {
  constexpr double rounded = 2e-3;  // m: capsules are round and hands are not
  int apart = 0, close = 0, piercing = 0;
  for (int i = 0; i < 200; ++i) {
    RandomStream random(1, "solid_hand_test", i, "posture");
    const Posture posture = random_posture(find_movement_family("any"), {0, 1}, random);
    const double overlap = deepest_overlap(solid_test_hand().skeleton(), posture);
    const double in_mesh = deepest_in_mesh(posture);
    if (overlap <= kMostOverlap) {
      EXPECT_LT(in_mesh, kMostOverlap + rounded) << i;
      ++apart;
      close += in_mesh <= kMostOverlap;
    } else {
      EXPECT_GT(in_mesh, 0) << i;
      ++piercing;
    }
  }
  EXPECT_GE(piercing, 20) << "there is something to leave out";
  EXPECT_GE(close, 0.97 * apart);
}

}  // namespace
}  // namespace glovebench::trajectories
