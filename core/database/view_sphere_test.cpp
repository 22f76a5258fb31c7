#include "core/database/view_sphere.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/math.h"

namespace glovebench {
namespace {

TEST(ViewSphere, has_42_directions_spread_over_the_whole_sphere) {
  const std::vector<Eigen::Vector3d> directions = camera_directions();
  ASSERT_EQ(directions.size(), 42u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(directions[i].norm(), 1, 1e-12);
    sum += directions[i];
    double nearest = 10;
    for (size_t j = 0; j < directions.size(); ++j)
      if (j != i) nearest = std::min(nearest, std::acos(directions[i].dot(directions[j])));
    // An icosahedron's edge spans atan(2) = 63.43 degrees; each is halved.
    EXPECT_NEAR(degrees_from_radians(nearest), 63.4349 / 2, 1e-3);
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-12);
}

TEST(ViewSphere, has_756_distinct_proper_rotations) {
  const std::vector<Eigen::Matrix3d>& rotations = view_rotations();
  ASSERT_EQ(rotations.size(), 756u);
  for (const Eigen::Matrix3d& R : rotations) {
    EXPECT_NEAR((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
  }
  double least = 10;
  for (size_t i = 0; i < rotations.size(); ++i)
    for (size_t j = i + 1; j < rotations.size(); ++j)
      least = std::min(least, Eigen::AngleAxisd(rotations[i].transpose() * rotations[j]).angle());
  EXPECT_GT(degrees_from_radians(least), 19.9);  // the step about the optical axis; no two views are nearer
}

TEST(ViewSphere, each_view_looks_from_its_direction_and_turns_about_the_optical_axis) {
  const std::vector<Eigen::Vector3d> directions = camera_directions();
  for (int view = 0; view < kViewCount; ++view) {
    const Eigen::Matrix3d& R_view_hand = view_rotations()[view];
    // The camera's forward axis in the hand frame points from the camera to the hand.
    const Eigen::Vector3d forward_hand = R_view_hand.transpose().col(2);
    ASSERT_NEAR((forward_hand + directions[view / kInPlaneRotations]).norm(), 0, 1e-12) << view;
    const int first = view - view % kInPlaneRotations;
    const Eigen::AngleAxisd turn(R_view_hand * view_rotations()[first].transpose());
    const double expected_deg = 20.0 * std::min(view - first, kInPlaneRotations - (view - first));
    ASSERT_NEAR(degrees_from_radians(turn.angle()), expected_deg, 1e-6) << view;
  }
}

}  // namespace
}  // namespace glovebench
