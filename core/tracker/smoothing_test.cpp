#include "core/tracker/smoothing.h"

#include <gtest/gtest.h>

namespace glovebench {
namespace {

TrackResult measured(double angle, double x, TrackStatus status = TrackStatus::tracked) {
  TrackResult result;
  result.status = status;
  result.posture_unfiltered.setConstant(angle);
  result.T_camera_hand_unfiltered =
      Eigen::Translation3d(x, 0, 0.7) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
  return result;
}

/// Smooths results one after the other.
struct Sequence {
  SmoothingConfig config = {};
  std::vector<TrackResult> results = {};
  TrackResult smooth(TrackResult result) {
    results.push_back(smoothed(std::move(result), results, config));
    return results.back();
  }
};

TEST(Smoothing, posture_error_decays_by_three_quarters_a_frame) {
  Sequence smoother;
  smoother.smooth(measured(1, 0));
  double expected = 1;
  for (int frame = 0; frame < 20; ++frame) {
    expected *= 0.75;
    EXPECT_NEAR(smoother.smooth(measured(0, 0)).posture[0], expected, 1e-12);
  }
}

TEST(Smoothing, reproduces_the_steps_of_the_papers_figure_5) {
  // 14.2984, 25.0216, 33.0639: a grasp 57.19 degrees away is approached by a quarter a frame.
  Sequence smoother;
  smoother.smooth(measured(0, 0));
  for (const double printed : {14.2984, 25.0216, 33.0639})
    EXPECT_NEAR(smoother.smooth(measured(57.19, 0)).posture[0], printed, 0.002);
}

TEST(Smoothing, leaves_the_pose_unless_configured) {
  Sequence paper;
  paper.smooth(measured(0, 0));
  const TrackResult result = paper.smooth(measured(0.4, 0.2));
  EXPECT_EQ(result.T_camera_hand.matrix(), result.T_camera_hand_unfiltered.matrix());

  SmoothingConfig config;
  config.pose_keep = 0.75;
  Sequence both{config};
  both.smooth(measured(0, 0));
  const TrackResult filtered = both.smooth(measured(0.4, 0.2));
  EXPECT_NEAR(filtered.T_camera_hand.translation().x(), 0.05, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(filtered.T_camera_hand.linear()).angle(), 0.1, 1e-12);
}

TEST(Smoothing, repeats_the_last_answer_while_lost_and_starts_anew_after_a_while) {
  SmoothingConfig config;
  config.forget_after = 3;
  Sequence smoother{config};
  smoother.smooth(measured(1, 0));
  EXPECT_EQ(smoother.smooth(measured(9, 9, TrackStatus::no_hand)).posture[0], 1);
  EXPECT_NEAR(smoother.smooth(measured(0, 0)).posture[0], 0.75, 1e-12);
  for (int i = 0; i < 3; ++i) smoother.smooth(measured(9, 9, TrackStatus::no_hand));
  EXPECT_EQ(smoother.smooth(measured(0, 0)).posture[0], 0);
}

TEST(Smoothing, needs_no_more_than_the_newest_results) {
  SmoothingConfig config;
  config.forget_after = 3;
  config.pose_keep = 0.5;
  Sequence whole{config};
  std::vector<TrackResult> newest;
  for (int frame = 0; frame < 60; ++frame) {
    const bool lost = frame % 13 < 2 || frame % 17 < 4;
    const TrackResult result =
        measured(0.01 * frame, 0.001 * frame, lost ? TrackStatus::no_hand : TrackStatus::tracked);
    const TrackResult expected = whole.smooth(result), found = smoothed(result, newest, config);
    EXPECT_EQ(found.posture, expected.posture) << frame;
    EXPECT_EQ(found.T_camera_hand.matrix(), expected.T_camera_hand.matrix()) << frame;
    newest.push_back(found);
    if (newest.size() > 3) newest.erase(newest.begin());
  }
}

}  // namespace
}  // namespace glovebench
