#include "eval/command_measurement.h"

#include <gtest/gtest.h>

#include "core/base/math.h"

namespace glovebench::eval {
namespace {

constexpr double kStep = 1.0 / 30;  // s

HandFrame frame_at(int i, double index_flexion, double x) {
  HandFrame frame;
  frame.timestamp_us = i * 1'000'000LL / 30;
  frame.posture[kIndexMcpFlexion] = index_flexion;
  frame.T_camera_hand.translation() = Eigen::Vector3d(x, 0, 0.8);
  return frame;
}

/// A hand that moves slowly.
std::vector<HandFrame> slow_movement(int count) {
  std::vector<HandFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(frame_at(i, 0.01 * i, 0.001 * i));
  return frames;
}

reports::CommandResult measure_commands(std::span<const TrackResult> results, std::span<const HandFrame> truth) {
  CommandMeasurement measurement;
  measurement.add(make_commands(results, {}, {}), make_commands(true_results(truth), {}, {}),
                  static_cast<int>(truth.size()));
  return measurement.result();
}

TEST(RobotCommands, OfTheTruthHaveNoError) {
  const auto truth = slow_movement(20);
  const reports::CommandResult result = measure_commands(true_results(truth), truth);
  EXPECT_EQ(result.frames, 20);
  EXPECT_EQ(result.sent, (std::array<int, kCountOf<CommandState>>{20, 0, 0}));
  EXPECT_NEAR(*result.rate_hz, 30, 1e-3);
  EXPECT_NEAR(*result.longest_gap_ms, 1e3 * kStep, 1e-2);
  EXPECT_TRUE(result.interventions.none());
  EXPECT_EQ(result.errors.joints_deg.count, 20);
  EXPECT_EQ(result.errors.joints_deg.max, 0);
  EXPECT_EQ(result.errors.position_mm.max, 0);
  EXPECT_EQ(result.errors.rotation_deg.max, 0);
  EXPECT_EQ(result.errors.arm_deg.count, 0) << "no arm in this setup";
  EXPECT_EQ(result.jerk, result.truth_jerk);
}

TEST(RobotCommands, ErrorsAreThoseOfTheTargets) {
  const auto truth = slow_movement(20);
  std::vector<TrackResult> results = true_results(truth);
  for (TrackResult& result : results) {
    result.posture[kIndexMcpFlexion] += radians_from_degrees(12);
    result.T_camera_hand.translation().y() += 0.004;
    result.T_camera_hand.rotate(Eigen::AngleAxisd(radians_from_degrees(5), Eigen::Vector3d::UnitZ()));
  }
  const reports::CommandErrors errors = measure_commands(results, truth).errors;
  EXPECT_NEAR(*errors.joints_deg.mean, 12 / std::sqrt(24.0), 1e-9) << "one of 24 joints";
  EXPECT_NEAR(*errors.position_mm.mean, 4, 1e-9);
  EXPECT_NEAR(*errors.rotation_deg.mean, 5, 1e-9);
}

TEST(RobotCommands, LostFramesHoldAndHaveNoError) {
  const auto truth = slow_movement(40);
  std::vector<TrackResult> results = true_results(truth);
  for (int i = 10; i < 40; ++i) results[static_cast<size_t>(i)].status = TrackStatus::no_hand;
  const reports::CommandResult result = measure_commands(results, truth);
  EXPECT_EQ(result.sent[static_cast<size_t>(CommandState::following)], 10);
  EXPECT_EQ(result.sent[static_cast<size_t>(CommandState::holding)], 15) << "half a second, from frame 9 on";
  EXPECT_EQ(result.sent[static_cast<size_t>(CommandState::stopped)], 15);
  EXPECT_EQ(result.interventions[Intervention::hold], 30);
  EXPECT_EQ(result.interventions[Intervention::stop], 1);
  EXPECT_EQ(result.errors.position_mm.count, 10);
  EXPECT_EQ(result.errors.position_mm.max, 0) << "where they follow";
}

TEST(RobotCommands, NothingTrackedIsCountedAndHasNoValues) {
  const auto truth = slow_movement(5);
  std::vector<TrackResult> results = true_results(truth);
  for (TrackResult& result : results) result.status = TrackStatus::no_hand;
  const reports::CommandResult result = measure_commands(results, truth);
  EXPECT_EQ(result.sent[static_cast<size_t>(CommandState::stopped)], 5);
  EXPECT_FALSE(result.jerk.joints_deg_s3.has_value());
  EXPECT_FALSE(result.truth_jerk.joints_deg_s3.has_value()) << "nothing to compare";
  EXPECT_EQ(result.errors.joints_deg.count, 0);
}

TEST(RobotCommands, DroppedOnesMissAndTheOthersKeepTheirTruth) {
  const auto truth = slow_movement(10);
  std::vector<TrackResult> results = true_results(truth);
  results[4].timestamp_us = results[3].timestamp_us;  // a clock that stands still
  const reports::CommandResult result = measure_commands(results, truth);
  EXPECT_EQ(result.frames, 10);
  EXPECT_EQ(result.sent[0], 9);
  EXPECT_EQ(result.interventions[Intervention::stale], 1);
  EXPECT_NEAR(*result.longest_gap_ms, 2e3 * kStep, 1e-2);
  EXPECT_EQ(result.errors.position_mm.count, 9);
  EXPECT_EQ(result.errors.position_mm.max, 0);
}

TEST(RobotCommands, JerkOfACubicIsItsThirdDerivative) {
  std::vector<HandFrame> truth;
  for (const int i : {0, 1, 2, 3, 5, 6, 8, 9, 10}) {  // unequal steps
    const double t = i * kStep;
    truth.push_back(frame_at(i, 0.5 * t * t * t, 0.25 * t * t * t));
    truth.back().timestamp_us = std::llround(t * 1e6);
  }
  const reports::CommandResult result = measure_commands(true_results(truth), truth);
  ASSERT_TRUE(result.interventions.none()) << "nothing is slowed down";
  EXPECT_NEAR(*result.jerk.position_m_s3, 6 * 0.25, 1e-3);
  EXPECT_NEAR(*result.jerk.joints_deg_s3, degrees_from_radians(6 * 0.5) / std::sqrt(24.0), 0.05);
}

TEST(RobotCommands, LosingTheHandIsNoSmoothness) {
  const auto truth = slow_movement(60);
  std::vector<TrackResult> results = true_results(truth);
  for (size_t i = 0; i < 60; ++i) {
    results[i].T_camera_hand.translation().y() += i % 2 == 0 ? 0.001 : 0;
    if (i >= 10) results[i].status = TrackStatus::no_hand;
  }
  const reports::CommandResult lost = measure_commands(results, truth);
  const reports::CommandResult whole = measure_commands(std::span(results).first(10), std::span(truth).first(10));
  EXPECT_EQ(lost.jerk, whole.jerk) << "what it held does not count";
  EXPECT_EQ(lost.truth_jerk, whole.truth_jerk) << "nor what the truth did meanwhile";
  EXPECT_GT(*lost.jerk.position_m_s3, 100 * *lost.truth_jerk.position_m_s3);
}

TEST(RobotCommands, PassesAddUp) {
  const auto truth = slow_movement(20);
  const CommandStream stream = make_commands(true_results(truth), {}, {});
  EXPECT_EQ(stream.command_ms.size(), 20U);
  CommandMeasurement one, two;
  one.add(stream, stream, 20);
  for (int pass = 0; pass < 2; ++pass) two.add(stream, stream, 20);
  EXPECT_EQ(two.result().frames, 40);
  EXPECT_EQ(two.result().sent[0], 40);
  EXPECT_NEAR(*two.result().rate_hz, *one.result().rate_hz, 1e-9) << "no gap between passes";
  EXPECT_EQ(two.result().errors.joints_deg.count, 40);
}

}  // namespace
}  // namespace glovebench::eval
