#include "eval/replay.h"

#include <gtest/gtest.h>

#include "eval/run_folder.h"
#include "eval/share.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

TEST(Replay, a_capsule_hand_has_joints_of_its_own) {
  // An estimate without any error of posture or pose: the tracker's fingertips are not the person's.
  Workbench workbench(test_workbench());
  const HandFrame frame = trajectories::source_trajectory(trajectory_folder(), "Tr4").frames[40];
  reports::FrameTruth truth;
  truth.posture = frame.posture;
  truth.T_camera_hand = frame.T_camera_hand;
  truth.T_hand_joint = workbench.subject(3).joints(frame.posture);
  TrackResult estimate;
  estimate.status = TrackStatus::tracked;
  estimate.posture = estimate.posture_unfiltered = frame.posture;
  estimate.T_camera_hand = frame.T_camera_hand;
  const reports::FrameErrors errors = reports::measure_frame(40, estimate, truth, *workbench.model());
  EXPECT_GT(errors.record["fingertip_error_mm"].value(), 2);
  EXPECT_GT(errors.record["joint_error_mm"].value(), 2);
  // The tracker's mesh is posed twice: no vertex is compared with one of the other hand.
  EXPECT_NEAR(errors.record["vertex_error_mm"].value(), 0, 1e-6);
}

TEST(ReplayLong, a_capsule_hand_is_tracked_and_shares_no_images) {
  Workbench workbench(test_workbench());
  Replay own;
  own.truth =
      std::make_shared<const trajectories::Trajectory>(trajectories::source_trajectory(trajectory_folder(), "Tr4"));
  own.databases = {"DB_open_power"};
  own.range = {0, 2};
  Replay other = own;
  other.subject = 7;
  EXPECT_FALSE(share_images(own, other));
  EXPECT_NE(replay_key(workbench, own), replay_key(workbench, other));
  const TrackedReplay tracked = replay(workbench, other).front();
  const TrackedReplay again = replay(workbench, other).front();
  for (size_t f = 0; f < 2; ++f) {
    ASSERT_EQ(tracked.results[f].status, TrackStatus::tracked);
    EXPECT_LT(tracked.errors[f].record["position_error_mm"].value(), 20);
    EXPECT_EQ(tracked.errors[f].record["position_error_mm"], again.errors[f].record["position_error_mm"]);
  }
}

TEST(ReplayLong, with_clutter_within_reach_shows_something_else) {
  Workbench workbench(test_workbench());
  Replay plain;
  plain.truth =
      std::make_shared<const trajectories::Trajectory>(trajectories::source_trajectory(trajectory_folder(), "Tr4"));
  plain.databases = {"DB_open_power"};
  plain.range = {40, 1};
  Replay cluttered = plain;
  EXPECT_TRUE(share_images(plain, cluttered));
  EXPECT_EQ(replay_key(workbench, plain), replay_key(workbench, cluttered));
  cluttered.clutter_in_volume = true;
  EXPECT_FALSE(share_images(plain, cluttered));
  EXPECT_NE(replay_key(workbench, plain), replay_key(workbench, cluttered));

  render::SyntheticKinect a = make_kinect(workbench, plain), b = make_kinect(workbench, cluttered);
  a.next_frame();
  b.next_frame();
  const TrackerConfig config = profile("paper");
  const auto pixels_in_volume = [&](const DepthImage& depth) {
    return std::ranges::count_if(depth,
                                 [&](float z) { return z >= config.volume.z_min && z <= config.volume.z_max; });
  };
  EXPECT_GT(pixels_in_volume(b.truth().depth), pixels_in_volume(a.truth().depth) + 1000);
}

}  // namespace
}  // namespace glovebench::eval
