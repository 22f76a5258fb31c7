#include <gtest/gtest.h>

#include "core/methods/method.h"
#include "core/tracker/test_scene.h"

namespace glovebench {
namespace {

std::unique_ptr<Method> method_named(std::string_view name) {
  TrackerConfig config;
  config.method = name;
  return find_method(name).make({config, synthetic_calibration(), borrowed(render::test_hand()),
                                 borrowed(test_database()), borrowed(test_color_table())});
}

/// Half-closed, each finger otherwise: 20 degrees from both postures of the database.
Posture unknown_posture() {
  Posture posture = 0.3 * power_posture();
  posture[kIndexMcpFlexion] += 0.3;
  posture[kMiddlePipFlexion] += 0.5;
  posture[kLittleMcpAbduction] = -0.3;
  posture[kWristFlexion] = 0.25;
  return posture;
}

TEST(Articulated, follows_postures_that_no_database_knows) {
  const Eigen::Isometry3d truth = render::test_pose({0.02, 0.03, 0.7}, {0.1, 0.2, 0.3});
  const DeviceFrame frame = shoot(truth, unknown_posture()).frame;
  const TrackResult paper = method_named(kPaperMethod)->track(frame),
                    result = method_named("articulated")->track(frame);
  ASSERT_EQ(result.status, TrackStatus::tracked);
  EXPECT_TRUE(result.converged);
  // Measured: 0.2 mm, 0.2 degrees, 2 degrees; the paper's method 14 degrees.
  EXPECT_LT(error_of(result.T_camera_hand, truth).mm, 0.6);
  EXPECT_LT(error_of(result.T_camera_hand, truth).deg, 0.6);
  EXPECT_LT(posture_distance(result.posture, unknown_posture()),
            0.4 * posture_distance(paper.posture, unknown_posture()));
  EXPECT_LT(degrees_from_radians(result.posture[kWristFlexion] - unknown_posture()[kWristFlexion]), 1);
}

TEST(Articulated, says_which_angles_it_does_not_see) {
  // From above a fist hides its fingertips, and an open hand nothing.
  const Eigen::Isometry3d truth = render::test_pose({0, 0.03, 0.7}, {0.2, 0, 0});
  const TrackResult open = method_named("articulated")->track(shoot(truth).frame);
  const TrackResult fist = method_named("articulated")->track(shoot(truth, power_posture()).frame);
  ASSERT_TRUE(open.certainty && fist.certainty);
  EXPECT_EQ(open.certainty->hidden, 0u);
  EXPECT_TRUE(fist.certainty->hidden >> kMiddleDipFlexion & 1);
  EXPECT_FALSE(fist.certainty->hidden >> kMiddleMcpFlexion & 1);
  EXPECT_GT(fist.certainty->deviation[kMiddleDipFlexion], 3 * open.certainty->deviation[kMiddleDipFlexion]);
  EXPECT_FALSE(method_named(kPaperMethod)->track(shoot(truth).frame).certainty);
}

TEST(Articulated, does_not_lag) {
  const auto method = method_named("articulated");
  const Eigen::Isometry3d before = render::test_pose({0.02, 0.03, 0.7}),
                          after = render::test_pose({0.05, 0.0, 0.65});
  const TrackResult first = method->track(shoot(before).frame);
  const TrackResult result = method->track(shoot(after, power_posture()).frame, {&first, 1});
  EXPECT_LT(error_of(result.T_camera_hand, after).mm, 1);
  EXPECT_EQ(result.posture, result.posture_unfiltered);
}

TEST(Articulated, repeats_its_last_answer_over_lost_frames) {
  const auto method = method_named("articulated");
  const DeviceFrame frame = shoot(render::test_pose({0.02, 0.03, 0.7})).frame;
  DeviceFrame nothing = frame;
  for (uint16_t& raw : nothing.raw_disparity) raw = 2047;
  const TrackResult seen = method->track(frame);
  const TrackResult lost = method->track(nothing, {&seen, 1});
  EXPECT_EQ(lost.status, TrackStatus::no_hand);
  EXPECT_EQ(lost.posture, seen.posture);
  EXPECT_EQ(lost.T_camera_hand.matrix(), seen.T_camera_hand.matrix());
  EXPECT_EQ(method->track(frame, std::vector{seen, lost}).status, TrackStatus::tracked);
}

}  // namespace
}  // namespace glovebench
