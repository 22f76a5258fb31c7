#include "eval/true_neighbor.h"

#include <gtest/gtest.h>

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/camera/rgbd_calibration.h"
#include "core/database/test_database.h"

namespace glovebench::eval {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

const TrueNeighborSearch& search() {
  static const TrueNeighborSearch search(render::test_hand(), test_database());
  return search;
}

const PinholeCamera kKinect = synthetic_calibration().ir;

/// The hand as in an entry's view, at the views' distance.
Isometry3d pose_of_entry(int entry) {
  Isometry3d T_camera_hand = Isometry3d::Identity();
  T_camera_hand.linear() = view_rotations()[Database::view(entry)];
  T_camera_hand.translation().z() = ViewConfig{}.distance;
  return T_camera_hand;
}

TEST(TrueNeighbor, of_a_view_is_its_entry) {
  for (const int entry : {0, 17, 400, 755, 756, 1200, 1511}) {
    const TrueNeighbor found = search().nearest(test_database().posture(entry), pose_of_entry(entry), kKinect);
    EXPECT_EQ(found.entry, entry);
    // The view's square has whole pixels, so its ray is off by up to half a pixel: 1 / 900 of 0.1 m.
    EXPECT_LT(found.distance, 0.2e-3) << entry;
  }
}

TEST(TrueNeighbor, does_not_change_when_the_hand_is_carried_around_the_camera) {
  // A look-up sees the same hand, except for the rotation about the ray.
  for (const int entry : {30, 900, 1300}) {
    const Posture& posture = test_database().posture(entry);
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(1, -1, 0)}) {
      const Isometry3d carried = AngleAxisd(radians_from_degrees(15), axis.normalized()) * pose_of_entry(entry);
      const TrueNeighbor found = search().nearest(posture, carried, kKinect);
      EXPECT_EQ(found.entry, entry);
      // Bounding squares differ a little when seen at an angle, so the rays differ by about a degree.
      EXPECT_LT(found.distance, 2e-3);
    }
  }
}

TEST(TrueNeighbor, the_distance_is_the_mean_over_the_vertices) {
  // A turn about the optical axis moves each vertex along a chord.
  const int entry = 100;
  const Posture& posture = test_database().posture(entry);
  const double angle = radians_from_degrees(5);
  Isometry3d turned = pose_of_entry(entry);
  turned.linear() = AngleAxisd(angle, Vector3d::UnitZ()) * turned.linear();
  const PosedHand hand = render::test_hand().pose(posture);
  double sum = 0;
  for (const Eigen::Vector3f& vertex : hand.vertices)
    sum += 2 * std::sin(angle / 2) * (turned.linear() * vertex.cast<double>()).head<2>().norm();
  const TrueNeighbor found = search().nearest(posture, turned, kKinect);
  EXPECT_EQ(found.entry, entry) << "the next views are 20 degrees away";
  // The hand's middle is off the axis, so its ray and its bounding square change with the turn.
  EXPECT_NEAR(found.distance, sum / static_cast<double>(hand.vertices.size()), 0.5e-3);
}

TEST(TrueNeighbor, fast_equals_plain) {
  for (int i = 0; i < 40; ++i) {
    RandomStream random(1, "true neighbor test", i, "query");
    const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
    Isometry3d T_camera_hand(q.normalized());
    T_camera_hand.translation() = Vector3d(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.7);
    Posture posture = random.uniform() * power_posture();
    for (double& angle : posture) angle += 0.2 * random.normal();
    const TrueNeighbor fast = search().nearest(posture, T_camera_hand, kKinect);
    const TrueNeighbor plain = search().nearest_plain(posture, T_camera_hand, kKinect);
    EXPECT_EQ(fast.entry, plain.entry) << i;
    EXPECT_EQ(fast.distance, plain.distance) << i;
  }
}

TEST(TrueNeighbor, of_equal_entries_is_the_smaller) {
  // Both postures are equal, so every entry has a twin 756 later.
  const PostureSet twins{"DB_twins", {"power", "again"}, {power_posture(), power_posture()}};
  const Database database = Database::build(twins, render::test_hand(), ViewConfig{},
                                            render::label_renderer_factory(), 2, {}, std::array{8});
  const TrueNeighborSearch twin_search(render::test_hand(), database);
  for (const int entry : {3, 759, 1000}) {
    const TrueNeighbor fast = twin_search.nearest(power_posture(), pose_of_entry(entry), kKinect);
    EXPECT_EQ(fast.entry, entry % kViewCount);
    EXPECT_EQ(twin_search.nearest_plain(power_posture(), pose_of_entry(entry), kKinect).entry, fast.entry);
  }
}

}  // namespace
}  // namespace glovebench::eval
