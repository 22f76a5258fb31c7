#include "trajectories/trajectory_properties.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/math.h"

namespace glovebench::trajectories {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Posture grasp() {
  Posture posture = Posture::Constant(1);
  posture.head<2>().setZero();
  return posture;
}

/// Frames 0.1 s apart whose fingers have gone these shares of the way to the grasp.
Trajectory closing(const std::vector<double>& shares) {
  Trajectory trajectory{.name = "t", .description = "", .provenance = {}, .frames = {}};
  for (size_t i = 0; i < shares.size(); ++i) {
    HandFrame& frame = trajectory.frames.emplace_back();
    frame.timestamp_us = static_cast<int64_t>(i) * 100'000;
    frame.posture = shares[i] * grasp();
  }
  return trajectory;
}

TEST(TrajectoryProperties, finds_transitions_and_holds) {
  const TrajectoryProperties properties =
      measure(closing({0, 0.05, 0, 0.3, 0.6, 1, 0.95, 0.5, 0.4, 0.9, 1, 0.2, 0}), Posture::Zero(), grasp());
  ASSERT_EQ(properties.transitions.size(), 2u) << "half way and back is no transition";
  EXPECT_EQ(properties.transitions[0].first_frame, 2);
  EXPECT_EQ(properties.transitions[0].last_frame, 5);
  EXPECT_TRUE(properties.transitions[0].closing);
  EXPECT_EQ(properties.transitions[1].first_frame, 10);
  EXPECT_EQ(properties.transitions[1].last_frame, 12);
  EXPECT_FALSE(properties.transitions[1].closing);
  // Settled: within 8 degrees = 0.14 rad of either.
  EXPECT_EQ(properties.longest_open_hold, 3);
  EXPECT_EQ(properties.longest_grasp_hold, 2);
  EXPECT_EQ(properties.settled_frames, 8);
}

TEST(TrajectoryProperties, measures_the_way_of_the_hand) {
  Trajectory trajectory = closing({0, 0, 0});
  trajectory.frames[1].T_camera_hand.translation() << 0.03, 0.04, 0;
  trajectory.frames[2].T_camera_hand.translation() << 0.03, 0, 0;
  trajectory.frames[2].T_camera_hand.linear() =
      Eigen::AngleAxisd(radians_from_degrees(50), Eigen::Vector3d::UnitY()).toRotationMatrix();
  trajectory.frames[1].posture[kWristFlexion] = -0.2;
  trajectory.frames[2].posture[kWristFlexion] = 0.1;
  const TrajectoryProperties properties = measure(trajectory, Posture::Zero(), grasp());
  // Rounding only.
  EXPECT_NEAR(properties.path_length, 0.09, 1e-12);
  EXPECT_NEAR(properties.travel, 0.05, 1e-12);
  EXPECT_NEAR(properties.peak_speed, 0.5, 1e-9);
  EXPECT_NEAR(properties.rotation, radians_from_degrees(50), 1e-9);
  EXPECT_NEAR(properties.wrist_flexion_range, 0.3, 1e-12);
  EXPECT_NEAR(properties.duration_s, 0.2, 1e-12);
}

TEST(TrajectoryProperties, of_a_single_frame_are_zero) {
  const TrajectoryProperties properties = measure(closing({0}), Posture::Zero(), grasp());
  EXPECT_EQ(properties.frames, 1);
  EXPECT_EQ(properties.peak_speed, 0);
  EXPECT_EQ(properties.travel, 0);
  EXPECT_TRUE(properties.transitions.empty());
}

/// A hand that goes from one distance to another and bends its fingers.
Trajectory moving(double from_m, double to_m, double bend_deg) {
  Trajectory trajectory{.name = "t", .description = "", .provenance = {}, .frames = {}};
  for (int i = 0; i <= 10; ++i) {
    HandFrame& frame = trajectory.frames.emplace_back();
    frame.T_camera_hand.translation().z() = from_m + (to_m - from_m) * i / 10;
    frame.posture.setConstant(radians_from_degrees(bend_deg) * i / 10);
  }
  return trajectory;
}

std::vector<std::string> doubts(const Trajectory& trajectory) { return unit_doubts(trajectory, {}); }

TEST(UnitDoubts, none_of_what_can_be) {
  EXPECT_THAT(doubts(moving(0.6, 0.8, 60)), IsEmpty());
  EXPECT_THAT(doubts(moving(0.6, 0.8, 0)), IsEmpty()) << "a flat hand";
  EXPECT_THAT(doubts(moving(0.6, 0.8, 4)), IsEmpty()) << "nearly flat";
  EXPECT_THAT(doubts(moving(0.7, 1.15, 60)), IsEmpty()) << "leaves the volume for less than half of the time";
}

TEST(UnitDoubts, other_units_of_positions) {
  EXPECT_THAT(
      doubts(moving(0.6e-3, 0.8e-3, 60)),
      ElementsAre("most frames lie outside of the working volume, 400 to 950 mm from the camera (z of the hand: "
                  "0.6 to 0.8 mm): the positions look like meters, position_mm is in millimeters"));
  EXPECT_THAT(doubts(moving(0.06, 0.08, 60)), ElementsAre(HasSubstr("look like centimeters")));
  EXPECT_THAT(doubts(moving(-0.6, -0.8, 60)), ElementsAre(HasSubstr("looks along -z")));
  EXPECT_THAT(doubts(moving(1.2, 1.5, 60)),
              ElementsAre(AllOf(HasSubstr("1200 to 1500 mm"), HasSubstr("z forward"))));
}

TEST(UnitDoubts, radians) {
  EXPECT_THAT(doubts(moving(0.6, 0.8, 1.05)),
              ElementsAre("no angle exceeds 1.05 degrees: the angles look like radians, "
                          "angles_deg is in degrees"));
  EXPECT_THAT(doubts(moving(0.6e-3, 0.8e-3, 1.05)).size(), 2U);
}

}  // namespace

}  // namespace glovebench::trajectories
