#include "core/pose/articulated_fit.h"

#include <gtest/gtest.h>

#include "core/pose/test_alignment.h"
#include "core/tracker/test_scene.h"

namespace glovebench {
namespace {

/// Points and mask of a posture in front of an ideal camera.
struct View {
  RecycledVector<LabeledPoint> points;
  HandMask mask;

  View(const ArticulatedPose& truth) {
    render::LabelRenderer renderer;
    const HandImages images =
        renderer.render_ids(test_hand(), test_hand().pose(truth.posture), kKinect, truth.T_camera_hand);
    points = build_cloud(images.depth, images.label, kKinect, WorkingVolume{}).points;
    mask.assign(images.depth, {Image<uint16_t>(640, 480, 900)}, label_box(images.label, 40), 2.0f);
  }
  HandObservation observation() const { return {points, mask, kKinect}; }
};

/// Each angle off by that many degrees, the pose by 5 mm and 5 degrees.
ArticulatedPose away_from(const ArticulatedPose& truth, double angle_deg, int number) {
  RandomStream random(1, "articulated fit", number, "start");
  ArticulatedPose start = truth;
  for (double& angle : start.posture) angle += radians_from_degrees(random.uniform(-angle_deg, angle_deg));
  start.posture = clamp_to_limits(start.posture);
  start.T_camera_hand = perturbed_by(truth.T_camera_hand, 5, 0.005, number);
  return start;
}

ArticulatedPose some_truth() {
  ArticulatedPose truth{Posture::Constant(0.25), test_pose({0.02, 0.03, 0.7}, {0.1, 0.2, 0.3})};
  truth.posture[kWristFlexion] = -0.2;
  return truth;
}

ArticulatedFit make_fit(Implementation implementation = Implementation::fast, const FitSchedule& schedule = {}) {
  return ArticulatedFit(borrowed(test_hand()), schedule, implementation);
}

TEST(ArticulatedFit, finds_pose_and_angles) {
  const ArticulatedPose truth = some_truth();
  const View view(truth);
  for (int number = 0; number < 3; ++number) {
    const ArticulatedPose start = away_from(truth, 15, number);
    const ArticulatedEstimate found = make_fit()(view.observation(), std::span(&start, 1), nullptr);
    ASSERT_EQ(found.status, AlignmentStatus::converged);
    EXPECT_LT(distance_mm(found.pose.T_camera_hand, truth.T_camera_hand), 0.2);
    EXPECT_LT(angle_deg(found.pose.T_camera_hand, truth.T_camera_hand), 0.2);
    // Measured: at most 3.0 degrees, nearly all of it in end joints of which the view shows little.
    EXPECT_LT(degrees_from_radians(posture_distance(found.pose.posture, truth.posture)), 5);
    EXPECT_LT(posture_distance(found.pose.posture, truth.posture),
              0.6 * posture_distance(start.posture, truth.posture));
    EXPECT_LT(found.residual, 0.0002);
  }
}

TEST(ArticulatedFit, takes_the_start_that_ends_best) {
  const ArticulatedPose truth = some_truth();
  const View view(truth);
  ArticulatedPose turned = truth;
  turned.T_camera_hand.linear() = turned.T_camera_hand.linear() * Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitY());
  const ArticulatedPose starts[] = {turned, away_from(truth, 10, 1)};
  EXPECT_EQ(make_fit()(view.observation(), starts, nullptr).start, 1);
  const ArticulatedPose reversed[] = {starts[1], starts[0]};
  EXPECT_EQ(make_fit()(view.observation(), reversed, nullptr).start, 0);
}

TEST(ArticulatedFit, leaves_what_it_cannot_see_where_the_frame_before_had_it) {
  // Seen along the fingers from the wrist, a fist hides its fingertips.
  ArticulatedPose truth{power_posture(), test_pose({0, 0.02, 0.7}, {0, 0, 0})};
  const View view(truth);
  Posture previous = truth.posture;
  const ArticulatedPose start = away_from(truth, 15, 3);
  const ArticulatedEstimate with = make_fit()(view.observation(), std::span(&start, 1), &previous);
  const ArticulatedEstimate without = make_fit()(view.observation(), std::span(&start, 1), nullptr);
  EXPECT_LT(posture_distance(with.pose.posture, truth.posture),
            0.85 * posture_distance(without.pose.posture, truth.posture));
}

TEST(ArticulatedFit, pushes_a_hidden_finger_out_of_its_neighbor) {
  const ArticulatedPose truth = some_truth();
  View view(truth);
  std::erase_if(view.points, [](const LabeledPoint& point) {
    return std::ranges::any_of(std::array{kIndexProximal, kIndexIntermediate, kIndexDistal},
                               [&](int patch) { return point.label == patch_labels()[patch]; });
  });
  ArticulatedPose start = truth;
  start.posture[kIndexMcpAbduction] = -0.2;
  const auto overlap_mm = [&](const FitSchedule& schedule) {
    const ArticulatedEstimate found =
        make_fit(Implementation::fast, schedule)(view.observation(), std::span(&start, 1), nullptr);
    double most = 0;
    for (const BonePair& pair : overlapping_bones(test_hand().pose(found.pose.posture).T_hand_joint, 0))
      most = std::max(most, 1000 * pair.overlap);
    return most;
  };
  FitSchedule soft;
  soft.bones_weight = 0;
  EXPECT_GT(overlap_mm(soft), 5);
  EXPECT_LT(overlap_mm({}), 3);
}

TEST(ArticulatedFit, outline_bends_a_finger_whose_end_no_point_shows) {
  // No point has a color of the index finger's outer segments; only the mask says that they are not straight.
  ArticulatedPose truth = some_truth();
  truth.posture[kIndexPipFlexion] = 1.3;
  View view(truth);
  std::erase_if(view.points, [&](const LabeledPoint& point) {
    return point.label == patch_labels()[kIndexIntermediate] || point.label == patch_labels()[kIndexDistal];
  });
  ArticulatedPose start = truth;
  start.posture[kIndexPipFlexion] = 0.25;
  FitSchedule blind;
  blind.outline_weight = 0;
  const auto bend = [&](const FitSchedule& schedule) {
    return make_fit(Implementation::fast, schedule)(view.observation(), std::span(&start, 1), nullptr)
        .pose.posture[kIndexPipFlexion];
  };
  EXPECT_LT(bend(blind), 0.5);
  EXPECT_GT(bend({}), 0.8);
}

TEST(ArticulatedFit, is_the_same_with_either_search) {
  const ArticulatedPose truth = some_truth(), start = away_from(truth, 15, 2);
  const View view(truth);
  const ArticulatedEstimate fast = make_fit()(view.observation(), std::span(&start, 1), nullptr);
  const ArticulatedEstimate plain =
      make_fit(Implementation::plain)(view.observation(), std::span(&start, 1), nullptr);
  EXPECT_EQ(fast.pose.posture, plain.pose.posture);
  EXPECT_EQ(fast.pose.T_camera_hand.matrix(), plain.pose.T_camera_hand.matrix());
}

TEST(ArticulatedFit, says_why_it_cannot) {
  const ArticulatedPose truth = some_truth();
  View view(truth);
  const auto status = [&] { return make_fit()(view.observation(), std::span(&truth, 1), nullptr).status; };
  for (LabeledPoint& point : view.points) point.label = 0;
  EXPECT_EQ(status(), AlignmentStatus::no_shared_color);
  view.points.resize(2);
  EXPECT_EQ(status(), AlignmentStatus::too_few_points);
}

}  // namespace
}  // namespace glovebench
