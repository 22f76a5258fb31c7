#include "core/pose/alignments/robust_alignment.h"

#include <gtest/gtest.h>

#include "core/pose/test_alignment.h"

namespace glovebench {
namespace {

const IcpConfig kRobust{.algorithm = "robust", .max_points = 3000};
const IcpConfig kHorn{.algorithm = "horn", .max_points = 3000};

TEST(RobustIcp, stays_at_the_truth) {
  const Eigen::Isometry3d truth = test_pose({0.02, 0.03, 0.7});
  const Alignment alignment = align(test_hand(), posed(), true_cloud(truth), truth, kRobust);
  // OpenGL's vertices snap to 1/256 px and its depth is single precision: micrometres.
  EXPECT_LT(distance_mm(alignment.T_camera_hand, truth), 0.05);
  EXPECT_LT(angle_deg(alignment.T_camera_hand, truth), 0.05);
  EXPECT_LT(alignment.residual, 2e-5);
  EXPECT_EQ(alignment.iterations, 11);
}

TEST(RobustIcp, recovers_the_pose_from_25_degrees_and_30_millimeters_with_at_most_half_of_horns_error) {
  double robust_mm = 0, horn_mm = 0, robust_deg = 0, horn_deg = 0;
  int recovered = 0;
  constexpr int kStarts = 24;
  for (int number = 0; number < kStarts; ++number) {
    RandomStream random(1, "icp", number / 8, "pose");
    const Eigen::Vector3d turn = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)};
    const Eigen::Isometry3d truth = test_pose({0.02, 0.03, 0.7}, turn);
    const RecycledVector<LabeledPoint> cloud = true_cloud(truth);
    const Eigen::Isometry3d start = perturbed_by(truth, 25, 0.030, number);
    const Eigen::Isometry3d robust = align(test_hand(), posed(), cloud, start, kRobust).T_camera_hand;
    const Eigen::Isometry3d horn = align(test_hand(), posed(), cloud, start, kHorn).T_camera_hand;
    robust_mm += distance_mm(robust, truth) / kStarts;
    horn_mm += distance_mm(horn, truth) / kStarts;
    robust_deg += angle_deg(robust, truth) / kStarts;
    horn_deg += angle_deg(horn, truth) / kStarts;
    recovered += distance_mm(robust, truth) < 2 && angle_deg(robust, truth) < 1;
  }
  RecordProperty("robust_um", static_cast<int>(1000 * robust_mm));
  RecordProperty("horn_um", static_cast<int>(1000 * horn_mm));
  EXPECT_EQ(recovered, kStarts);
  EXPECT_LT(robust_mm, 0.5 * horn_mm);
  EXPECT_LT(robust_deg, 0.5 * horn_deg);
}

TEST(RobustIcp, says_when_it_was_not_let_finish) {
  const Eigen::Isometry3d truth = test_pose({0.02, 0.03, 0.7});
  IcpConfig config = kRobust;
  config.max_iterations = 4;
  const Alignment four = align(test_hand(), posed(), true_cloud(truth), perturbed(truth, 3), config);
  EXPECT_EQ(four.status, AlignmentStatus::not_converged);
  EXPECT_EQ(four.iterations, 4);
  EXPECT_LT(distance_mm(four.T_camera_hand, truth), distance_mm(perturbed(truth, 3), truth));
}

TEST(RobustIcp, fewer_than_three_points_are_too_few) {
  const Eigen::Isometry3d start = test_pose({0, 0, 0.7});
  const RecycledVector<LabeledPoint> cloud = true_cloud(start);
  for (const size_t count : {0, 1, 2}) {
    const Alignment alignment = align(test_hand(), posed(), std::span(cloud).first(count), start, kRobust);
    EXPECT_EQ(alignment.status, AlignmentStatus::too_few_points);
    EXPECT_EQ(alignment.T_camera_hand.matrix(), start.matrix());
  }
}

TEST(RobustIcp, points_that_are_not_finite_take_no_part) {
  const Eigen::Isometry3d truth = test_pose({0.02, 0.03, 0.7});
  RecycledVector<LabeledPoint> cloud = true_cloud(truth);
  for (size_t i = 0; i < cloud.size(); i += 7) cloud[i].p.y() = std::numeric_limits<float>::quiet_NaN();
  const Alignment alignment = align(test_hand(), posed(), cloud, perturbed(truth, 5), kRobust);
  EXPECT_LT(distance_mm(alignment.T_camera_hand, truth), 0.2);
  for (LabeledPoint& point : cloud) point.p.y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(align(test_hand(), posed(), cloud, truth, kRobust).status, AlignmentStatus::no_shared_color);
}

TEST(RobustIcp, a_single_color_has_an_answer) {
  const Eigen::Isometry3d truth = test_pose({0.02, 0.03, 0.7});
  const RecycledVector<LabeledPoint> cloud = true_cloud(truth);
  for (uint8_t label = 1; label <= kColorCount; ++label) {
    RecycledVector<LabeledPoint> some;
    for (const LabeledPoint& point : cloud)
      if (point.label == label) some.push_back(point);
    if (some.size() < 100) continue;
    const Alignment alignment = align(test_hand(), posed(), some, truth, kRobust);
    EXPECT_TRUE(alignment.T_camera_hand.matrix().allFinite()) << int{label};
    EXPECT_LT(distance_mm(alignment.T_camera_hand, truth), 2) << int{label};
  }
}

}  // namespace
}  // namespace glovebench
