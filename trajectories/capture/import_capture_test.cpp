#include "trajectories/capture/import_capture.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "ci/build_paths.h"
#include "core/base/math.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "trajectories/capture/test_capture.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

using testing::HasSubstr;

Trajectory movement(size_t frames) {
  Trajectory trajectory = load_trajectory(build_paths::source("trajectories/data/sources/Tr4.json"));
  trajectory.frames.resize(frames);
  return trajectory;
}
const HandModel& model_of_side(Side side = Side::right) {
  static const HandModel right = HandModel::load(build_paths::hand_mesh());
  static const HandModel left = HandModel::load(build_paths::hand_mesh(), Side::left);
  return side == Side::right ? right : left;
}
/// The joints of a movement of a hand of that side, through a file.
HandFit imported(const Trajectory& truth, Side side) {
  const std::string path = test_folder() + "/joints.csv";
  write_file(path, csv_markers(captured(truth, model_of_side(side), webxr_names(), {})));
  return import_capture({path}, find_marker_format("csv"), side, {}, model_of_side());
}

TEST(ImportCapture, gives_a_trajectory_before_the_camera_that_saw_it) {
  const Trajectory truth = movement(12);
  for (const Side side : {Side::right, Side::left}) {
    const HandFit fit = imported(truth, side);
    const Trajectory found = trajectory_of(fit, {side, test_T_capture_camera()}, "mine", 1);
    EXPECT_EQ(parse_trajectory(canonical_text(found), "text").side, side);
    ASSERT_EQ(found.frames.size(), truth.frames.size());
    for (size_t f = 0; f < truth.frames.size(); ++f) {
      const Eigen::Isometry3d difference = truth.frames[f].T_camera_hand.inverse() * found.frames[f].T_camera_hand;
      // The prior of a hand's parts moves the palm a little.
      EXPECT_LT(difference.translation().norm(), 0.0005) << f;
      EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), radians_from_degrees(0.5)) << f;
    }
  }
}

TEST(ImportCapture, puts_the_hand_below_the_camera_if_nobody_says_where_that_is) {
  const HandFit fit = imported(movement(12), Side::right);
  const Trajectory found = trajectory_of(fit, {}, "mine", 5);
  ASSERT_EQ(found.frames.size(), 3U) << "every fifth of 12";
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const HandFrame& frame : found.frames) mean += frame.T_camera_hand.translation() / 3;
  EXPECT_LT((mean - Eigen::Vector3d(0, 0, kViewingDistance)).norm(), 1e-9);
  const Eigen::Matrix3d R = found.frames[1].T_camera_hand.linear();
  EXPECT_LT(R(2, 1), -0.9) << "the back of the hand (+y) towards the camera (-z)";
  EXPECT_GT(R(1, 2), 0.9) << "the fingers (-z) up in the image (-y)";
}

TEST(ImportCapture, gives_the_postures_that_differ_most) {
  const HandFit fit = imported(movement(40), Side::right);
  const PostureSet set = postures_of(fit, "mine", 4, {});
  ASSERT_EQ(set.postures.size(), 4U);
  EXPECT_EQ(set.posture_names[0], "frame_0");
  double farthest = 0;
  for (const FittedFrame& frame : fit.frames)
    farthest = std::max(farthest, posture_distance(frame.state.posture, set.postures[0]));
  EXPECT_DOUBLE_EQ(posture_distance(set.postures[1], set.postures[0]), farthest);
  EXPECT_EQ(postures_of(fit, "all", 100, {}).postures.size(), 40U);
}

TEST(ImportCapture, reports_each_frame_and_the_whole) {
  const HandFit fit = imported(movement(3), Side::right);
  const std::string table = residual_table(fit);
  EXPECT_EQ(std::ranges::count(table, '\n'), 4);
  EXPECT_THAT(table, HasSubstr("\n1,66667,25,0."));
  EXPECT_THAT(table, HasSubstr(",0,fitted,wrist_flexion wrist_abduction\n"));
  EXPECT_THAT(summary(fit), HasSubstr("3 frames, 0 left out"));
  EXPECT_THAT(summary(fit), HasSubstr("not shown: wrist_flexion wrist_abduction"));
}

/// Poses that a headset captured (npm handy-work): another hand, whose lengths and palm the fit has to find.
TEST(ImportCapture, fits_captured_poses_of_another_hand) {
  const std::string folder = std::filesystem::path(build_paths::hand_mesh()).parent_path().string();
  const std::vector<std::string> paths = {folder + "/fist.handpose", folder + "/flat.handpose",
                                          folder + "/horns.handpose"};
  for (const Side side : {Side::right, Side::left}) {
    const HandFit fit = import_capture(paths, find_marker_format("handpose"), side, {}, model_of_side());
    const PostureSet set = postures_of(fit, "captured", 3, {"fist", "flat", "horns"});
    const auto degrees = [&](int pose, int angle) { return degrees_from_radians(set.postures[pose][angle]); };
    for (const int pip : {kIndexPipFlexion, kMiddlePipFlexion, kRingPipFlexion, kLittlePipFlexion}) {
      EXPECT_GT(degrees(0, pip), 80) << "a fist's fingers are bent";
      EXPECT_NEAR(degrees(1, pip), 0, 15) << "a flat hand's are not";
    }
    EXPECT_NEAR(degrees(2, kIndexPipFlexion), 0, 15) << "horns: index and little finger out";
    EXPECT_NEAR(degrees(2, kLittlePipFlexion), 0, 15);
    EXPECT_GT(degrees(2, kMiddlePipFlexion), 80);
    for (const FittedFrame& frame : fit.frames) {
      std::vector<double> residuals = frame.residuals;
      std::ranges::nth_element(residuals, residuals.begin() + 12);
      EXPECT_LT(residuals[12], 0.002) << "of a joint; its palm bends, ours does not";
    }
  }
}

}  // namespace
}  // namespace glovebench::trajectories
