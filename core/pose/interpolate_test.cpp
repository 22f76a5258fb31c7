#include "core/pose/interpolate.h"

#include <gtest/gtest.h>

#include "core/base/math.h"
#include "core/database/test_database.h"

namespace glovebench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

double rotation_apart_deg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return degrees_from_radians(Quaterniond(a).angularDistance(Quaterniond(b)));
}

Quaterniond about_z(double degrees) {
  return Quaterniond(Eigen::AngleAxisd(radians_from_degrees(degrees), Vector3d::UnitZ()));
}

TEST(MeanRotation, does_not_care_for_the_sign_of_a_quaternion) {
  const Quaterniond q(Eigen::AngleAxisd(2.5, Vector3d(1, 2, -3).normalized()));
  const Quaterniond minus(Eigen::Vector4d(-q.coeffs()));
  const std::vector<Quaterniond> rotations = {q, minus, q};
  const std::vector<double> weights = {1, 5, 2};
  EXPECT_NEAR(mean_rotation(rotations, weights).angularDistance(q), 0, 1e-7);  // acos near 1
}

TEST(MeanRotation, about_one_axis_is_the_weighted_circular_mean) {
  // About one axis the largest eigenvector lies at atan2(sum w sin a, sum w cos a).
  const std::vector<Quaterniond> rotations = {about_z(170), about_z(-170), about_z(150)};
  const std::vector<double> weights = {1, 3, 2};
  double s = 0, c = 0;
  const double angles_deg[] = {170, -170, 150};
  for (int i = 0; i < 3; ++i) {
    s += weights[i] * std::sin(radians_from_degrees(angles_deg[i]));
    c += weights[i] * std::cos(radians_from_degrees(angles_deg[i]));
  }
  const Quaterniond expected = about_z(degrees_from_radians(std::atan2(s, c)));
  EXPECT_NEAR(mean_rotation(rotations, weights).angularDistance(expected), 0, 1e-7);
}

TEST(Interpolate, weighs_by_the_inverse_of_the_error) {
  const Database& database = test_database();
  const int view = 100;
  const RecycledVector<Match> matches = {{view, 0.99f}, {kViewCount + view, 2.99f}};  // open, power
  const CoarseEstimate estimate = interpolate(database, matches, database.box_ray(view), 0.01);
  // Weights 1 / 1 and 1 / 3: the second has a quarter of the sum.
  EXPECT_NEAR((estimate.posture - 0.25 * power_posture()).norm(), 0, 1e-6);  // errors are single precision
  EXPECT_FALSE(estimate.ambiguous);
}

TEST(Interpolate, without_a_ray_the_view_keeps_its_rotation) {
  const Database& database = test_database();
  const RecycledVector<Match> matches = {{250, 0.5f}};
  const Eigen::Matrix3d& R_view = view_rotations()[250];
  EXPECT_LT(rotation_apart_deg(interpolate(database, matches, std::nullopt, 0.01).R_camera_hand, R_view), 1e-5);
  const Vector3d ray = Vector3d(0.3, 0, 1).normalized();
  EXPECT_GT(rotation_apart_deg(interpolate(database, matches, ray, 0.01).R_camera_hand, R_view), 10);
}

TEST(Interpolate, epsilon_bounds_the_weight_of_a_perfect_match) {
  const Database& database = test_database();
  const RecycledVector<Match> matches = {{0, 0.0f}, {kViewCount, 0.5f}};
  const CoarseEstimate estimate = interpolate(database, matches, database.box_ray(0), 0.5);
  // Weights 1 / 0.5 and 1 / 1.
  EXPECT_NEAR((estimate.posture - power_posture() / 3).norm(), 0, 1e-6);
}

TEST(Interpolate, one_match_on_its_own_ray_is_its_view) {
  const Database& database = test_database();
  for (const int entry : {0, 333, 1511}) {
    const RecycledVector<Match> match = {{entry, 1.0f}};
    const CoarseEstimate estimate = interpolate(database, match, database.box_ray(entry), 0.01);
    EXPECT_NEAR((estimate.R_camera_hand - view_rotations()[entry % kViewCount]).norm(), 0, 1e-9);
    EXPECT_EQ(estimate.posture, database.posture(entry));
  }
}

TEST(Interpolate, is_ambiguous_when_two_rotations_differ_by_more_than_60_degrees) {
  const Database& database = test_database();
  // Views of one camera position are 20 degrees apart. Their rays differ a little as well: 40 and 80 are clear.
  const auto ambiguous = [&](int steps) {
    const RecycledVector<Match> matches = {{0, 1.0f}, {1, 1.0f}, {steps, 1.0f}};
    return interpolate(database, matches, Vector3d::UnitZ(), 0.01).ambiguous;
  };
  EXPECT_FALSE(ambiguous(2));
  EXPECT_TRUE(ambiguous(4));
  EXPECT_TRUE(ambiguous(9));
}

TEST(Interpolate, turns_the_view_to_the_ray_of_a_hand_beside_the_optical_axis) {
  // The camera of a view is turned away about its own center: the hand appears beside the axis and looks the same.
  const Database& database = test_database();
  const PinholeCamera kinect{640, 480, 575.816, 575.816, 319.5, 239.5};
  const Cascade cascade = {{64, 1}};
  render::LabelRenderer renderer;
  for (const int entry : {40, 250, 600, kViewCount + 300}) {
    for (const Vector3d& target : {Vector3d(0.3, 0, 1), Vector3d(-0.25, 0.2, 1), Vector3d(0, -0.25, 1)}) {
      const Quaterniond turn = Quaterniond::FromTwoVectors(database.box_ray(entry), target);
      Eigen::Isometry3d T_view_hand = Eigen::Isometry3d::Identity();
      T_view_hand.linear() = view_rotations()[Database::view(entry)];
      T_view_hand.translation().z() = 0.75;
      const Eigen::Isometry3d T_camera_hand = turn * T_view_hand;
      const LabelImage labels = renderer.render_labels(
          render::test_hand(), render::test_hand().pose(database.posture(entry)), kinect, T_camera_hand);
      const Square square = bounding_square(labels);
      const RecycledVector<Match> matches = look_up(database, make_tiny_images(labels, square, cascade), cascade);
      EXPECT_EQ(matches[0].entry, entry);
      const CoarseEstimate estimate = interpolate(database, matches, square_ray(square, kinect), 0.01);
      // A pixel of the box is 0.1 degrees, the stretch of a plane image at 17 degrees off the axis moves the box's
      // middle by less than one; without the correction the error is the whole turn, 14 to 18 degrees.
      EXPECT_LT(rotation_apart_deg(estimate.R_camera_hand, T_camera_hand.linear()), 1.0);
      EXPECT_GT(rotation_apart_deg(view_rotations()[Database::view(entry)], T_camera_hand.linear()), 10);
    }
  }
}

}  // namespace
}  // namespace glovebench
