#include "eval/measured_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/math.h"
#include "core/base/random.h"
#include "reports/metrics/example_frame.h"

namespace glovebench::eval {
namespace {

using reports::make_estimate;
using reports::some_pose;
using reports::some_posture;

/// Of a value computed in doubles from meters and radians.
constexpr double kRounding = 1e-6;

struct Sequence {
  std::vector<TrackResult> estimates;
  std::vector<HandFrame> truth;
  reports::SequenceMetrics measure() const { return measure_sequence(estimates, truth); }
};

/// A hand at rest for `count` frames, estimated without error.
Sequence resting(int count) {
  Sequence s;
  for (int i = 0; i < count; ++i) {
    s.truth.push_back({i * 66667, some_posture(), some_pose()});
    s.estimates.push_back(make_estimate());
  }
  return s;
}

/// The index finger bends back and forth by 40 degrees; the estimate is the truth `delay` frames earlier.
Sequence bending(int count, int delay) {
  Sequence s = resting(count);
  const auto posture_at = [](int i) {
    Posture posture = some_posture();
    for (int a = kIndexMcpAbduction; a < kAngleCount; ++a) posture[a] += 0.7 * std::sin(0.2 * i);
    return posture;
  };
  for (int i = 0; i < count; ++i) {
    s.truth[i].posture = posture_at(i);
    s.estimates[i].posture = posture_at(i - delay);
  }
  return s;
}

TEST(MeasureSequence, NothingCanBeToldFromNothing) {
  for (const int count : {0, 1}) {
    const reports::SequenceMetrics metrics = resting(count).measure();
    EXPECT_FALSE(metrics.jitter_position_mm || metrics.jitter_rotation_deg || metrics.latency_frames);
  }
  Sequence uneven = resting(20);
  uneven.truth.pop_back();
  EXPECT_THROW(uneven.measure(), std::logic_error);
}

TEST(MeasureSequence, JitterOfAnAlternatingEstimateIsItsStep) {
  Sequence s = resting(40);
  for (size_t i = 0; i < s.estimates.size(); ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    s.estimates[i].T_camera_hand.translation().x() += sign * 0.001;
    s.estimates[i].T_camera_hand.linear() =
        s.estimates[i].T_camera_hand.linear() *
        Eigen::AngleAxisd(sign * radians_from_degrees(0.5), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  EXPECT_NEAR(*s.measure().jitter_position_mm, 2, kRounding);
  EXPECT_NEAR(*s.measure().jitter_rotation_deg, 1, kRounding);
}

TEST(MeasureSequence, JitterOfNoiseOfKnownSize) {
  Sequence s = resting(2000);
  RandomStream random(1, "metrics_test", 0, "jitter");
  for (TrackResult& estimate : s.estimates)
    for (int axis = 0; axis < 3; ++axis) estimate.T_camera_hand.translation()[axis] += 0.001 * random.normal();
  // The difference of two draws has twice the variance, in three axes. Four standard deviations of the estimate
  // from 2000 frames (6000 squared draws, neighbors correlated by -1/2) are 4%.
  EXPECT_NEAR(*s.measure().jitter_position_mm, std::sqrt(6.0), 0.04 * std::sqrt(6.0));
}

TEST(MeasureSequence, JitterIgnoresConstantErrorsMovementAndLostFrames) {
  Sequence s = resting(40);
  for (TrackResult& estimate : s.estimates) estimate.T_camera_hand.translation().y() += 0.01;
  EXPECT_NEAR(*s.measure().jitter_position_mm, 0, kRounding);

  s.estimates[20].status = TrackStatus::no_hand;
  s.estimates[20].T_camera_hand = Eigen::Isometry3d::Identity();
  EXPECT_NEAR(*s.measure().jitter_position_mm, 0, kRounding);

  for (size_t i = 0; i < s.truth.size(); ++i) s.truth[i].T_camera_hand.translation().x() += 0.002 * i;
  EXPECT_FALSE(s.measure().jitter_position_mm) << "2 mm a frame is no rest";
  EXPECT_FALSE(resting(10).measure().jitter_position_mm) << "nine steps are too few";
  EXPECT_TRUE(resting(11).measure().jitter_position_mm);
}

TEST(MeasureSequence, LatencyOfADelayedCopyIsItsDelay) {
  // The parabola through a minimum of |x| is exact up to the asymmetry of its two neighbors.
  for (const int delay : {1, 3, 6}) EXPECT_NEAR(*bending(100, delay).measure().latency_frames, delay, 0.02);
  EXPECT_EQ(bending(100, 0).measure().latency_frames, 0);
}

TEST(MeasureSequence, LatencyOfTheRecursiveFilterIsItsPhaseDelay) {
  Sequence s = bending(120, 0);
  for (size_t i = 1; i < s.truth.size(); ++i)
    s.estimates[i].posture = 0.75 * s.estimates[i - 1].posture + 0.25 * s.truth[i].posture;
  // x = 0.75 x + 0.25 new delays a slow movement by 3 frames, and a sine of 0.2 rad per frame by this. The
  // distance is no parabola, since the filter also flattens the sine and starts at rest.
  const double delay = std::atan(0.75 * std::sin(0.2) / (1 - 0.75 * std::cos(0.2))) / 0.2;
  EXPECT_NEAR(*s.measure().latency_frames, delay, 0.05);
}

TEST(MeasureSequence, LatencyDoesNotLookAtLostFrames) {
  Sequence s = bending(100, 3);
  for (int i = 15; i < 60; ++i) {
    s.estimates[i].status = TrackStatus::no_hand;
    s.estimates[i].posture = s.truth[i].posture;  // as if there were no delay
  }
  EXPECT_NEAR(*s.measure().latency_frames, 3, 0.02);
  for (TrackResult& estimate : s.estimates) estimate.status = TrackStatus::no_hand;
  EXPECT_FALSE(s.measure().latency_frames);
  EXPECT_FALSE(s.measure().jitter_position_mm);
}

TEST(MeasureSequence, LatencyNeedsMovementAndThirtyFrames) {
  EXPECT_FALSE(resting(100).measure().latency_frames);
  EXPECT_FALSE(bending(29, 3).measure().latency_frames);
  EXPECT_TRUE(bending(30, 3).measure().latency_frames);
}

}  // namespace
}  // namespace glovebench::eval
