#include "core/pose/closest_point_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/test_simd.h"
#include "render/test_hand.h"

namespace glovebench {
namespace {

using render::test_hand;
using Points = RecycledVector<LabeledPoint>;

Eigen::Vector3f point_within(RandomStream& random, double reach) {
  return {static_cast<float>(random.uniform(-reach, reach)), static_cast<float>(random.uniform(-reach, reach)),
          static_cast<float>(random.uniform(-reach, reach))};
}

/// Points of all labels in and around the hand.
Points points_of_all_labels(int count) {
  RandomStream random(1, "closest", 0, "points");
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back({point_within(random, 0.12), static_cast<uint8_t>(1 + random.index(kColorCount))});
  return points;
}

void expect_bit_equal(const RecycledVector<ClosestPoint>& found, const RecycledVector<ClosestPoint>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].face, expected[i].face) << "point " << i;
    ASSERT_EQ(found[i].distance, expected[i].distance) << "point " << i;
    ASSERT_EQ(found[i].p_hand, expected[i].p_hand) << "point " << i;
  }
}

/// The search at one set of points after the other equals the plain one, on every instruction set.
void expect_plain_answers(const Surface& surface, const std::vector<Points>& sequence) {
  std::vector<RecycledVector<ClosestPoint>> expected;
  for (const Points& points : sequence) expected.push_back(closest_points_plain(points, surface));
  on_each_instruction_set([&] {
    ClosestPointSearch search(surface);
    for (size_t i = 0; i < sequence.size(); ++i) {
      SCOPED_TRACE(i);
      expect_bit_equal(search(sequence[i]), expected[i]);
      if (::testing::Test::HasFatalFailure()) return;
    }
  });
}

/// The same points again and again, moved as the alignment moves them: by large steps, then smaller and smaller
/// ones, none at all, and a jump in between.
std::vector<Points> motions(Points points) {
  RandomStream random(1, "closest", 0, "motions");
  std::vector<Points> sequence;
  for (const double step : {0.0, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 0.0, 1e-5, 1e-6, 0.1, 1e-4, 1e-4, 1e-7, 0.0}) {
    Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
    T.linear() = Eigen::AngleAxisf(static_cast<float>(5 * step), point_within(random, 1).normalized()).matrix();
    T.translation() = point_within(random, step);
    for (LabeledPoint& point : points) point.p = T * point.p;
    sequence.push_back(points);
  }
  return sequence;
}

Surface test_surface(Surface::Coloring coloring = Surface::Coloring::by_color) {
  return Surface(test_hand(), test_hand().pose(render::test_posture()), {0.1f, 0.7f, 0.1f}, coloring);
}

TEST(ClosestPointSearch, equals_the_plain_one_bit_for_bit_however_the_points_move) {
  expect_plain_answers(test_surface(), motions(points_of_all_labels(400)));
}

TEST(ClosestPointSearch, equals_the_plain_one_on_a_surface_of_any_color) {
  Points points = points_of_all_labels(60);
  for (LabeledPoint& point : points) point.label = Surface::kAnyColor;
  expect_plain_answers(test_surface(Surface::Coloring::any_color), motions(points));
}

TEST(ClosestPointSearch, many_small_steps_do_not_add_up_to_an_error) {
  Points points = points_of_all_labels(150);
  std::vector<Points> sequence;
  for (int i = 0; i < 100; ++i) {
    for (LabeledPoint& point : points) point.p += Eigen::Vector3f(4e-4f, -2e-4f, 3e-4f);
    sequence.push_back(points);
  }
  expect_plain_answers(test_surface(), sequence);
}

TEST(ClosestPointSearch, of_equally_close_faces_it_finds_the_first) {
  // A vertex of the mesh is equally close to all the faces around it, the middle of an edge to two.
  const Surface surface = test_surface();
  Points points;
  for (uint8_t label = 1; label <= kColorCount; ++label) {
    for (const Surface::Face& face : surface.faces(label)) {
      points.push_back({face.c, label});
      points.push_back({(face.a + face.b) / 2, label});
      points.push_back({(face.a + face.b + face.c) / 3, label});
    }
  }
  const RecycledVector<ClosestPoint> plain = closest_points_plain(points, surface);
  int shared = 0;  // points where a later face is as close
  for (size_t i = 0; i < points.size(); ++i) {
    const auto& faces = surface.faces(points[i].label);
    for (size_t f = plain[i].face + 1; f < faces.size(); ++f) {
      const Eigen::Vector3f p = points[i].p;
      if ((closest_on_triangle(p, faces[f]) - p).norm() == plain[i].distance) {
        ++shared;
        break;
      }
    }
  }
  EXPECT_GT(shared, 1000);
  expect_plain_answers(surface, {points, points});
}

/// A hand some of whose triangles have collapsed to a line or a spot within rounding: none has an area worth its
/// name, and some still look at the viewpoint.
PosedHand collapsed_hand() {
  PosedHand hand = test_hand().pose(render::test_posture());
  RandomStream random(1, "closest", 0, "collapse");
  for (int i = 0; i < 300; ++i) {
    const Triangle& triangle = test_hand().triangles()[random.index(test_hand().triangles().size())];
    Eigen::Vector3f& a = hand.vertices[triangle.vertices[0]];
    Eigen::Vector3f& b = hand.vertices[triangle.vertices[1]];
    Eigen::Vector3f& c = hand.vertices[triangle.vertices[2]];
    const auto share = static_cast<float>(random.uniform(0, 1));
    if (i % 3 == 0) c = a + share * (b - a);                                   // in the middle of an edge
    if (i % 3 == 1) c = a + 3 * share * (b - a) + point_within(random, 1e-7);  // beyond it, almost
    if (i % 3 == 2) b = a + point_within(random, 1e-8);                        // nearly a spot
  }
  return hand;
}

float rounding_blur(const Surface::Face& face) {
  FacePackets packets;
  packets.assign({&face, 1});
  return packets.face_boxes.front().blur[0];
}

int thin_faces(const Surface& surface) {
  int count = 0;
  for (uint8_t label = 1; label <= kColorCount; ++label)
    for (const Surface::Face& face : surface.faces(label)) count += std::isinf(rounding_blur(face));
  return count;
}

TEST(ClosestPointSearch, equals_the_plain_one_where_faces_have_collapsed) {
  const Surface surface(test_hand(), collapsed_hand(), {0.1f, 0.7f, 0.1f});
  ASSERT_GT(thin_faces(surface), 50);
  Points points = points_of_all_labels(300);
  for (uint8_t label = 1; label <= kColorCount; ++label)
    for (const Surface::Face& face : surface.faces(label)) points.push_back({face.b, label});
  expect_plain_answers(surface, motions(points));
}

TEST(ClosestPointSearch, equals_the_plain_one_where_vertices_are_not_finite) {
  PosedHand hand = test_hand().pose(render::test_posture());
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < 60; ++i) hand.vertices[13 * i][i % 3] = i % 2 == 0 ? kNan : kInf;
  const Surface surface(test_hand(), hand, {0.1f, 0.7f, 0.1f});
  expect_plain_answers(surface, motions(points_of_all_labels(200)));
}

TEST(ClosestPointSearch, a_point_that_is_not_finite_has_none_and_may_become_finite) {
  const Points finite = points_of_all_labels(60);
  Points broken = finite;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const float values[] = {kNan, kInf, -kInf, 1e30f, 1e19f, 1e15f, 1e6f};  // the last three have squares
  for (size_t i = 0; i < broken.size(); ++i) broken[i].p[i % 3] = values[i % std::size(values)];
  const Surface surface = test_surface();
  expect_plain_answers(surface, {finite, broken, broken, finite, finite});
  EXPECT_EQ(ClosestPointSearch(surface)(broken)[0].face, -1);
  EXPECT_GE(ClosestPointSearch(surface)(broken)[6].face, 0);
}

TEST(ClosestPointSearch, no_points_no_faces_and_colors_without_faces) {
  // From inside the palm of the open hand no face of color 7 looks at the viewer.
  const Surface from_inside(test_hand(), test_hand().pose(Posture::Zero()), {0.0003f, -0.0091f, 0.0078f});
  ASSERT_TRUE(from_inside.faces(7).empty());
  const Points points = points_of_all_labels(100);
  expect_plain_answers(from_inside, {points, points, {}, points});
  expect_plain_answers(Surface(), {points, {}, points});
}

TEST(ClosestPointSearch, points_may_change_their_labels_and_their_number) {
  const Points points = points_of_all_labels(150);
  Points others = points;
  for (LabeledPoint& point : others) point.label = static_cast<uint8_t>(1 + point.label % kColorCount);
  const Points fewer(others.begin(), others.begin() + 50);
  expect_plain_answers(test_surface(), {points, points, points, others, others, fewer, points, points, others});
}

TEST(ClosestPointSearch, equals_the_plain_one_near_vertices_of_thin_faces) {
  // Faces of several packets are equally near, and what rounding does to one does not say what it does to another.
  const Surface surface(test_hand(), collapsed_hand(), {0.1f, 0.7f, 0.1f});
  Points points;
  for (uint8_t label = 1; label <= kColorCount; ++label)
    for (size_t f = 0; f < surface.faces(label).size(); f += 5) {
      const Surface::Face& face = surface.faces(label)[f];
      points.push_back({face.c, label});
      points.push_back({face.a + 0.05f * (face.a - (face.b + face.c) / 2), label});
    }
  std::vector<Points> sequence = {points};
  RandomStream random(1, "closest", 0, "nudges");
  for (const double nudge : {1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 1e-5, 0.0}) {
    for (LabeledPoint& point : points) point.p += point_within(random, nudge);
    sequence.push_back(points);
  }
  expect_plain_answers(surface, sequence);
}

TEST(ClosestPointSearch, starts_anew_on_another_surface) {
  const Points points = points_of_all_labels(100);
  const Surface first = test_surface(), second(test_hand(), test_hand().pose(Posture::Zero()), {0, -0.7f, 0});
  ClosestPointSearch search(first);
  search(points);
  search.start(second);
  expect_bit_equal(search(points), closest_points_plain(points, second));
  search.start(first);
  expect_bit_equal(search(points), closest_points_plain(points, first));
}

TEST(RoundingBlur, bounds_how_far_outside_a_face_its_closest_point_comes_to_lie) {
  RandomStream random(1, "closest", 0, "thin");
  double largest = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double thinness = std::pow(10, random.uniform(-4.5, 0));
    const Eigen::Vector3f a = point_within(random, 0.1), along = point_within(random, 0.004);
    const Eigen::Vector3f across = static_cast<float>(thinness) * point_within(random, 0.004);
    const auto share = static_cast<float>(random.uniform(-0.2, 1.2));
    const Surface::Face face{a, a + along, a + share * along + across, 0};
    const float blur = rounding_blur(face);
    if (std::isinf(blur)) continue;
    // Above the face, near its middle: there rounding decides between inside and edge.
    const Eigen::Vector3f middle = (face.a + face.b + face.c) / 3;
    const auto reach = static_cast<float>(std::pow(10, random.uniform(-3, -1)));
    const Eigen::Vector3f p =
        middle + reach * along.cross(across).normalized() + static_cast<float>(random.uniform(0, 2)) * across;
    const Eigen::Vector3f closest = closest_on_triangle(p, face);
    // It lies outside by what its distances to the edges say; the box of the face bounds them from below.
    const Eigen::Vector3f low = face.a.cwiseMin(face.b).cwiseMin(face.c),
                          high = face.a.cwiseMax(face.b).cwiseMax(face.c);
    const double outside = (closest - closest.cwiseMax(low).cwiseMin(high)).norm();
    const double distance = (p - middle).norm() + along.norm() + across.norm();
    const double allowed = blur * distance * distance + 1e-6 * 0.1;
    largest = std::max(largest, outside / allowed);
    ASSERT_LE(outside, allowed) << "length " << along.norm() << ", thinness " << thinness << ", at " << reach;
  }
  RecordProperty("largest_share_of_the_bound_percent", static_cast<int>(100 * largest));
}

}  // namespace
}  // namespace glovebench
