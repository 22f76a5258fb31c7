#include "core/pose/box_placement.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/camera/rgbd_calibration.h"
#include "render/label_renderer.h"
#include "render/test_hand.h"

namespace glovebench {
namespace {

using render::test_hand;

const PinholeCamera kCamera{640, 480, 500, 500, 320, 240};

/// A plate of 0.1 m x 0.06 m parallel to the image.
const std::vector<Eigen::Vector3f> kPlate = {
    {-0.05f, -0.03f, 0}, {0.05f, -0.03f, 0}, {0.05f, 0.03f, 0}, {-0.05f, 0.03f, 0}};

Eigen::Isometry3d random_pose(int number) {
  RandomStream random(1, "box placement", number, "pose");
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return Eigen::Translation3d(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.45, 0.9)) *
         q.normalized();
}

TEST(ImageSquare, covers_its_pixels) {
  const ImageSquare square = image_square({10, 20, 4});  // pixels 10..13, which reach from 9.5 to 13.5
  EXPECT_EQ(square.middle_px, Eigen::Vector2d(11.5, 21.5));
  EXPECT_EQ(square.side_px, 4);
}

TEST(ProjectedSquare, of_a_plate_is_as_computed_by_hand) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(0.1, -0.2, 0.5);
  const auto square = projected_square(kPlate, T, kCamera);
  ASSERT_TRUE(square);
  EXPECT_NEAR(square->side_px, 100, 1e-4);
  EXPECT_NEAR(square->middle_px.x(), 420, 1e-4);
  EXPECT_NEAR(square->middle_px.y(), 40, 1e-4);
  EXPECT_FALSE(projected_square({}, T, kCamera));
  T.translation().z() = -0.5;
  EXPECT_FALSE(projected_square(kPlate, T, kCamera));
}

TEST(PlaceInSquare, recovers_a_plate_exactly) {
  const auto placed = place_in_square(kPlate, Eigen::Matrix3d::Identity(), {{420, 40}, 100}, kCamera);
  ASSERT_TRUE(placed);
  EXPECT_TRUE(placed->converged);
  EXPECT_LT((placed->T_camera_hand.translation() - Eigen::Vector3d(0.1, -0.2, 0.5)).norm(), 1e-6);
}

TEST(PlaceInSquare, recovers_the_hand_from_its_projected_box) {
  const PinholeCamera camera = synthetic_calibration().rgb;
  const PosedHand hand = test_hand().pose(render::test_posture());
  for (int number = 0; number < 50; ++number) {
    const Eigen::Isometry3d truth = random_pose(number);
    const auto observed = projected_square(hand.vertices, truth, camera);
    ASSERT_TRUE(observed);
    const auto placed = place_in_square(hand.vertices, truth.linear(), *observed, camera);
    ASSERT_TRUE(placed);
    EXPECT_TRUE(placed->converged);
    // 0.01 px of about 130 px at up to 0.9 m: 0.07 mm.
    const Eigen::Vector3d off = placed->T_camera_hand.translation() - truth.translation();
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-4) << "pose " << number << ": " << off.transpose();
    EXPECT_EQ(placed->T_camera_hand.linear(), truth.linear());
  }
}

TEST(PlaceInSquare, recovers_the_hand_from_its_true_labels_within_a_pixel) {
  const PinholeCamera camera = synthetic_calibration().rgb;
  const PosedHand hand = test_hand().pose(render::test_posture());
  render::LabelRenderer renderer;
  double mean_z = 0;
  constexpr int kPoses = 20;
  for (int number = 0; number < kPoses; ++number) {
    const Eigen::Isometry3d truth = random_pose(number);
    const LabelImage labels = renderer.render_labels(test_hand(), hand, camera, truth);
    const ImageSquare observed = image_square(bounding_square(labels));
    const auto placed = place_in_square(hand.vertices, truth.linear(), observed, camera);
    ASSERT_TRUE(placed);
    const Eigen::Vector3d off = placed->T_camera_hand.translation() - truth.translation();
    // A pixel more or less of the side, half a pixel of the middle.
    const double z = truth.translation().z();
    EXPECT_LT(std::abs(off.z()), 1.5 * z / observed.side_px) << "pose " << number;
    EXPECT_LT(off.head<2>().norm(), 3 * z / camera.fx) << "pose " << number;
    mean_z += off.z() / kPoses;
  }
  // No bias by half a pixel, which would be 2 mm.
  EXPECT_LT(std::abs(mean_z), 1.5e-3);
}

TEST(PlaceInSquare, refuses_what_has_no_place) {
  const PosedHand hand = test_hand().pose(Posture::Zero());
  EXPECT_FALSE(place_in_square(hand.vertices, Eigen::Matrix3d::Identity(), {}, kCamera));
  EXPECT_FALSE(place_in_square({}, Eigen::Matrix3d::Identity(), {{320, 240}, 100}, kCamera));
  EXPECT_FALSE(place_in_square(hand.vertices, Eigen::Matrix3d::Identity(), {{320, 240}, 20000}, kCamera));
}

}  // namespace
}  // namespace glovebench
