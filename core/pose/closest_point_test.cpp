#include "core/pose/closest_point.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "render/test_hand.h"

namespace glovebench {
namespace {

using render::test_hand;

Eigen::Vector3f random_point(RandomStream& random, double reach) {
  return {static_cast<float>(random.uniform(-reach, reach)), static_cast<float>(random.uniform(-reach, reach)),
          static_cast<float>(random.uniform(-reach, reach))};
}

/// The nearest of a grid of points on the triangle, corners and edges included.
float sampled_distance(const Eigen::Vector3f& p, const Surface::Face& face, int steps) {
  float best = std::numeric_limits<float>::infinity();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const float s = static_cast<float>(i) / steps, t = static_cast<float>(j) / steps;
      best = std::min(best, (face.a + s * (face.b - face.a) + t * (face.c - face.a) - p).norm());
    }
  }
  return best;
}

TEST(ClosestOnTriangle, is_on_the_triangle_and_as_near_as_its_nearest_sample) {
  RandomStream random(1, "closest", 0, "triangles");
  for (int i = 0; i < 500; ++i) {
    const Surface::Face face{random_point(random, 1), random_point(random, 1), random_point(random, 1), 0};
    const Eigen::Vector3f p = random_point(random, 2);
    const Eigen::Vector3f closest = closest_on_triangle(p, face);
    const float sampled = sampled_distance(p, face, 60);
    EXPECT_LE((closest - p).norm(), sampled + 1e-5f);  // single precision at coordinates of 2
    // The nearest sample lies within one cell of the grid: at most 3.5 / 60 away.
    EXPECT_GE((closest - p).norm(), sampled - 3.5f / 60);
    EXPECT_LT(sampled_distance(closest, face, 60), 3.5f / 60);
    const Eigen::Vector3f normal = (face.b - face.a).cross(face.c - face.a).normalized();
    EXPECT_NEAR(normal.dot(closest - face.a), 0, 1e-5);
  }
}

TEST(ClosestOnTriangle, knows_corners_edges_and_the_inside) {
  const Surface::Face face{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0};
  using V = Eigen::Vector3f;
  EXPECT_EQ(closest_on_triangle({-1, -1, 3}, face), V(0, 0, 0));
  EXPECT_EQ(closest_on_triangle({4, -1, 3}, face), V(2, 0, 0));
  EXPECT_EQ(closest_on_triangle({-1, 5, 3}, face), V(0, 2, 0));
  EXPECT_EQ(closest_on_triangle({0.5, -1, 3}, face), V(0.5, 0, 0));
  EXPECT_EQ(closest_on_triangle({-1, 0.5, 3}, face), V(0, 0.5, 0));
  EXPECT_EQ(closest_on_triangle({2, 2, 3}, face), V(1, 1, 0));
  EXPECT_EQ(closest_on_triangle({0.5, 0.25, 3}, face), V(0.5, 0.25, 0));
}

TEST(Surface, keeps_the_faces_that_look_at_the_viewpoint) {
  const PosedHand hand = test_hand().pose(render::test_posture());
  const Eigen::Vector3f viewpoint(0.1f, 0.6f, 0.2f);
  const Surface surface(test_hand(), hand, viewpoint);
  std::vector<bool> kept(test_hand().triangles().size());
  for (uint8_t label = 1; label <= kColorCount; ++label) {
    for (const Surface::Face& face : surface.faces(label)) {
      EXPECT_EQ(test_hand().triangles()[face.triangle].label, label);
      kept[face.triangle] = true;
    }
  }
  for (size_t t = 0; t < kept.size(); ++t) {
    const auto& v = test_hand().triangles()[t].vertices;
    const Eigen::Vector3d a = hand.vertices[v[0]].cast<double>(), b = hand.vertices[v[1]].cast<double>(),
                          c = hand.vertices[v[2]].cast<double>();
    const double facing = (b - a).cross(c - a).normalized().dot(viewpoint.cast<double>() - a);
    if (std::abs(facing) > 1e-5) {  // m; edge-on within rounding may fall either way
      EXPECT_EQ(kept[t], facing > 0) << t;
    }
  }
}

/// Points of all labels in and around the hand.
RecycledVector<LabeledPoint> points_around_the_hand(int count) {
  RandomStream random(1, "closest", 0, "points");
  RecycledVector<LabeledPoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({random_point(random, 0.12), static_cast<uint8_t>(1 + random.index(kColorCount))});
  }
  return points;
}

TEST(ClosestPoints, plain_search_finds_the_nearest_face_of_the_color) {
  const PosedHand hand = test_hand().pose(render::test_posture());
  const Surface surface(test_hand(), hand, {0, 0.7f, 0});
  const RecycledVector<LabeledPoint> points = points_around_the_hand(100);
  const RecycledVector<ClosestPoint> closest = closest_points_plain(points, surface);
  for (size_t i = 0; i < points.size(); ++i) {
    ASSERT_GE(closest[i].face, 0);
    const auto& faces = surface.faces(points[i].label);
    EXPECT_EQ(closest[i].p_hand, closest_on_triangle(points[i].p, faces[closest[i].face]));
    EXPECT_FLOAT_EQ(closest[i].distance, (closest[i].p_hand - points[i].p).norm());
    for (const Surface::Face& face : faces) {
      ASSERT_GE((closest_on_triangle(points[i].p, face) - points[i].p).norm(), closest[i].distance * 0.999999f);
    }
  }
}

TEST(ClosestPoints, a_color_that_faces_away_gives_face_minus_1) {
  // From inside the palm of the open hand no face of color 7 looks at the viewer; from outside each color shows.
  const PosedHand hand = test_hand().pose(Posture::Zero());
  const Surface from_inside(test_hand(), hand, {0.0003f, -0.0091f, 0.0078f});
  const Surface from_outside(test_hand(), hand, {0, 0.7f, 0});
  const RecycledVector<LabeledPoint> points = {{{0.01f, 0.02f, 0.03f}, 7}};
  ASSERT_TRUE(from_inside.faces(7).empty());
  EXPECT_EQ(closest_points_plain(points, from_inside)[0].face, -1);
  EXPECT_GE(closest_points_plain(points, from_outside)[0].face, 0);
}

TEST(ClosestPoints, a_point_that_is_not_finite_or_very_far_away_has_none) {
  const Surface surface(test_hand(), test_hand().pose(Posture::Zero()), {0, 0.7f, 0});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& p :
       {Eigen::Vector3f(kNan, 0, 0), Eigen::Vector3f(0, 0, kNan), Eigen::Vector3f(0, kInf, 0),
        Eigen::Vector3f(-kInf, kInf, 0), Eigen::Vector3f(0, 1e30f, 0)}) {
    const LabeledPoint point{p, 5};
    const ClosestPoint closest = closest_points_plain({&point, 1}, surface)[0];
    EXPECT_EQ(closest.face, -1) << p.transpose();
    EXPECT_EQ(closest.distance, 0);
    EXPECT_EQ(closest.p_hand, Eigen::Vector3f(0, 0, 0));
  }
}

}  // namespace
}  // namespace glovebench
