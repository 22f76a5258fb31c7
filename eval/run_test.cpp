#include "eval/measured_run.h"

#include <gtest/gtest.h>

#include "eval/program.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/families/movement.h"

namespace glovebench::eval {
namespace {

RunSpec spec_of_tr4(const FrameRange& frames) {
  return {.trajectory = std::make_shared<const trajectories::Trajectory>(
              trajectories::source_trajectory(trajectory_folder(), "Tr4")),
          .frames = frames,
          .database = "DB_open_power"};
}

TEST(Run, a_capsule_hand_has_joints_of_its_own) {
  // An estimate without error of posture or pose, but the tracker's fingertips are not the subject's.
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
  // Poses the tracker's mesh twice, so vertices of the subject's hand are not compared.
  EXPECT_NEAR(errors.record["vertex_error_mm"].value(), 0, 1e-6);
}

TEST(RunLong, a_capsule_hand_is_tracked_and_shares_no_images) {
  Workbench workbench(test_workbench());
  const RunSpec own = spec_of_tr4({0, 2});
  RunSpec other = own;
  other.subject = 7;
  EXPECT_FALSE(share_images(own, other));
  EXPECT_NE(run_key(workbench, own), run_key(workbench, other));
  const MeasuredRun tracked = measure(workbench, execute(workbench, {&other, 1}, {})).front();
  const MeasuredRun again = measure(workbench, execute(workbench, {&other, 1}, {})).front();
  for (size_t f = 0; f < 2; ++f) {
    ASSERT_EQ(tracked.run.answers[f].status, TrackStatus::tracked);
    EXPECT_LT(tracked.errors[f].record["position_error_mm"].value(), 20);
    EXPECT_EQ(tracked.errors[f].record["position_error_mm"], again.errors[f].record["position_error_mm"]);
  }
}

/// Errors of angles in units of their standard deviations.
std::vector<double> relative_errors(const Run& run, bool hidden) {
  std::vector<double> errors;
  const std::span<const HandFrame> truth = frames_of(run.spec);
  for (size_t f = 0; f < truth.size(); ++f) {
    const TrackResult& answer = run.answers[f];
    if (answer.status != TrackStatus::tracked) continue;
    for (int a = 0; a < kAngleCount; ++a)
      if ((answer.certainty->hidden >> a & 1) == hidden)
        errors.push_back(std::abs(answer.posture[a] - truth[f].posture[a]) / answer.certainty->deviation[a]);
  }
  return errors;
}

TEST(RunLong, errors_of_angles_keep_to_their_deviations) {
  Workbench workbench(test_workbench());
  const trajectories::MovementMaterial material =
      trajectories::load_movement_material(trajectory_folder(), HandModel::load(hand_mesh_path()).skeleton());
  RunSpec spec = spec_of_tr4({});
  spec.tracker.method = "articulated";
  std::vector<double> of_seen, of_hidden;
  for (const char* family : {"any", "fast"}) {
    spec.trajectory = std::make_shared<const trajectories::Trajectory>(
        generate_movement(trajectories::find_movement_family(family), 301, material, 60));
    const auto run = execute(workbench, {&spec, 1}, {}).front();
    std::ranges::copy(relative_errors(run, false), std::back_inserter(of_seen));
    std::ranges::copy(relative_errors(run, true), std::back_inserter(of_hidden));
  }
  const auto share_within = [](const std::vector<double>& errors, double deviations) {
    return static_cast<double>(std::ranges::count_if(errors, [&](double e) { return e < deviations; })) /
           static_cast<double>(errors.size());
  };
  // Errors of neighboring frames are alike: two movements are not many, and two postures to start from are few.
  for (const auto& errors : {of_seen, of_hidden}) {
    ASSERT_GT(errors.size(), 100U);
    EXPECT_NEAR(share_within(errors, 1), 0.68, 0.12);
    EXPECT_NEAR(share_within(errors, 2), 0.95, 0.1);
  }
}

TEST(RunLong, of_a_group_equals_the_run_alone) {
  Workbench workbench(test_workbench());
  std::vector<RunSpec> specs(4, spec_of_tr4({38, 3}));
  specs[1].database = "DB_open_pinch";
  specs[2].seed = 2;
  specs[3].tracker.icp.subsampling_factor = 8;
  const std::vector<eval::Run> together = execute(workbench, specs, {});
  ASSERT_EQ(together.size(), specs.size());
  for (size_t s = 0; s < specs.size(); ++s) {
    const eval::Run alone = execute(workbench, {&specs[s], 1}, {}).front();
    ASSERT_EQ(together[s].answers.size(), 3U);
    for (size_t f = 0; f < 3; ++f) {
      const TrackResult& answer = together[s].answers[f];
      EXPECT_EQ(answer.posture, alone.answers[f].posture) << s;
      EXPECT_TRUE(answer.T_camera_hand.matrix() == alone.answers[f].T_camera_hand.matrix()) << s;
      EXPECT_EQ(together[s].seen[f].visible_pixels, alone.seen[f].visible_pixels) << s;
      EXPECT_TRUE(together[s].seen[f].trackable);
      if (s < 2) continue;  // another database may give the same match
      EXPECT_FALSE(answer.T_camera_hand.matrix() == together[0].answers[f].T_camera_hand.matrix()) << s;
    }
  }
}

TEST(RunLong, with_clutter_within_reach_shows_something_else) {
  Workbench workbench(test_workbench());
  const RunSpec plain = spec_of_tr4({40, 1});
  RunSpec cluttered = plain;
  EXPECT_TRUE(share_images(plain, cluttered));
  EXPECT_EQ(run_key(workbench, plain), run_key(workbench, cluttered));
  cluttered.clutter_in_volume = true;
  EXPECT_FALSE(share_images(plain, cluttered));
  EXPECT_NE(run_key(workbench, plain), run_key(workbench, cluttered));

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
