#include "eval/metrics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "ci/build_paths.h"
#include "core/base/angles.h"
#include "core/base/random.h"
#include "core/hand/skeleton.h"

namespace glovebench::eval {
namespace {

using trajectories::TrajectoryFrame;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Of a value computed in doubles from metres and radians.
constexpr double kRounding = 1e-6;

const HandModel& hand() {
  static const HandModel model = HandModel::load(build_paths::hand_mesh());
  return model;
}

Posture some_posture() {
  Posture posture = Posture::Zero();
  posture[kIndexMcpFlexion] = 0.4;
  posture[kRingPipFlexion] = 0.7;
  return posture;
}

Eigen::Isometry3d some_pose() {
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  T_camera_hand.linear() = Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  T_camera_hand.translation() = Eigen::Vector3d(0.05, -0.02, 0.7);
  return T_camera_hand;
}

FrameTruth make_truth() {
  FrameTruth truth{some_posture(), some_pose(), hand().pose(some_posture()).T_hand_joint, {}};
  truth.visible_pixels.fill(1000);
  truth.trackable = true;
  return truth;
}

/// An estimate that is right.
TrackResult make_estimate() {
  TrackResult estimate;
  estimate.timestamp_us = 66667;
  estimate.status = TrackStatus::tracked;
  estimate.posture = estimate.posture_unfiltered = some_posture();
  estimate.T_camera_hand = some_pose();
  return estimate;
}

reports::FrameRecord measure(const TrackResult& estimate, const FrameTruth& truth = make_truth()) {
  return measure_frame(7, estimate, truth, hand()).record;
}

TEST(MeasureFrame, PerfectEstimateHasNoError) {
  const reports::FrameRecord record = measure(make_estimate());
  EXPECT_EQ(record.frame, 7);
  EXPECT_EQ(record.timestamp_us, 66667);
  EXPECT_TRUE(record.covered);
  EXPECT_FALSE(record.false_tracked || record.false_lost);
  for (const auto& error : {record.position_error_mm, record.rotation_error_deg, record.posture_rms_deg,
                            record.posture_mean_abs_deg, record.posture_rms_unfiltered_deg, record.vertex_error_mm,
                            record.joint_error_mm, record.fingertip_error_mm}) {
    EXPECT_NEAR(error.value(), 0, kRounding);
  }
  EXPECT_FALSE(record.matching_error_px) << "no match, no matching error";
  EXPECT_FALSE(record.posture_rms_hidden_deg) << "no joint is hidden";
  EXPECT_FALSE(record.icp_residual_mm) << "a method without alignment has no residual";
}

TEST(MeasureFrame, AnAlignmentHasAResidual) {
  TrackResult estimate = make_estimate();
  estimate.icp_points = 3;
  estimate.icp_residual = 0.002;
  EXPECT_NEAR(measure(estimate).icp_residual_mm.value(), 2, kRounding);
}

TEST(MeasureFrame, TranslationMovesEveryPointAlike) {
  TrackResult estimate = make_estimate();
  estimate.T_camera_hand.translation() += Eigen::Vector3d(0.003, -0.004, 0.012);
  const reports::FrameRecord record = measure(estimate);
  for (const auto& error :
       {record.position_error_mm, record.vertex_error_mm, record.joint_error_mm, record.fingertip_error_mm}) {
    EXPECT_NEAR(error.value(), 13, 1e-4) << "3-4-12-13; vertices are floats of under 0.2 m";
  }
  EXPECT_NEAR(*record.rotation_error_deg, 0, kRounding);
  EXPECT_NEAR(*record.posture_rms_deg, 0, kRounding);
}

TEST(MeasureFrame, RotationAboutTheHandsOriginMovesPointsByTheChord) {
  const double angle = radians_from_degrees(10);
  TrackResult estimate = make_estimate();
  estimate.T_camera_hand.linear() =
      estimate.T_camera_hand.linear() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const FrameErrors errors = measure_frame(0, estimate, make_truth(), hand());
  EXPECT_NEAR(*errors.record.rotation_error_deg, 10, kRounding);
  EXPECT_NEAR(*errors.record.position_error_mm, 0, kRounding);
  const JointPoses& joints = make_truth().T_hand_joint;
  ASSERT_EQ(errors.joint_errors_mm.size(), static_cast<size_t>(kForearmJoint));
  double tips = 0;
  for (const int tip : fingertip_joints()) {
    const Eigen::Vector3d p = joints[tip].translation();
    const double chord_mm = 1000 * 2 * std::sin(angle / 2) * std::hypot(p.x(), p.z());
    EXPECT_NEAR(errors.joint_errors_mm[tip], chord_mm, kRounding) << joint_name(tip);
    tips += chord_mm / 5;
  }
  EXPECT_NEAR(*errors.record.fingertip_error_mm, tips, kRounding);
}

TEST(MeasureFrame, OneJointMovesOnlyWhatHangsOnIt) {
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexPipFlexion] += radians_from_degrees(22);
  const FrameErrors errors = measure_frame(0, estimate, make_truth(), hand());
  const reports::FrameRecord& record = errors.record;
  EXPECT_NEAR(*record.posture_rms_deg, 22 / std::sqrt(22.0), kRounding);
  EXPECT_NEAR(*record.posture_mean_abs_deg, 1, kRounding);
  EXPECT_NEAR(*record.posture_rms_without_wrist_deg, 22 / std::sqrt(20.0), kRounding);
  EXPECT_NEAR(*record.posture_mean_abs_without_wrist_deg, 1.1, kRounding);
  EXPECT_NEAR(*record.posture_rms_unfiltered_deg, 0, kRounding) << "only the smoothed posture is wrong";
  EXPECT_NEAR(*record.position_error_mm, 0, kRounding);
  EXPECT_GT(*record.vertex_error_mm, 0.1);
  for (int joint = 0; joint < kForearmJoint; ++joint) {
    const bool moved =
        joint == joint_index("index-finger-phalanx-distal") || joint == joint_index("index-finger-tip");
    if (moved) {
      EXPECT_GT(errors.joint_errors_mm[joint], 5) << joint_name(joint);
    } else {
      EXPECT_NEAR(errors.joint_errors_mm[joint], 0, kRounding) << joint_name(joint);
    }
  }
}

TEST(MeasureFrame, WristStandsApart) {
  TrackResult estimate = make_estimate();
  estimate.posture[kWristFlexion] -= radians_from_degrees(22);
  const reports::FrameRecord record = measure(estimate);
  EXPECT_NEAR(*record.posture_mean_abs_deg, 1, kRounding);
  EXPECT_NEAR(*record.posture_rms_without_wrist_deg, 0, kRounding);
  EXPECT_NEAR(*record.joint_error_mm, 0, kRounding) << "the forearm is no keypoint";
  EXPECT_GT(*record.vertex_error_mm, 0.01) << "the cuff moves";
}

TEST(MeasureFrame, SplitsThePostureIntoObservedAndHidden) {
  FrameTruth truth = make_truth();
  truth.visible_pixels.fill(0);
  truth.visible_pixels[kIndexDistal] = kObservedPixels;  // moved by the index finger's four angles
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexDipFlexion] += radians_from_degrees(10);
  estimate.posture[kRingPipFlexion] -= radians_from_degrees(20);
  const reports::FrameRecord record = measure(estimate, truth);
  EXPECT_NEAR(*record.posture_rms_observed_deg, 10 / std::sqrt(4.0), kRounding);
  EXPECT_NEAR(*record.posture_rms_hidden_deg, 20 / std::sqrt(18.0), kRounding);

  truth.visible_pixels[kIndexDistal] = kObservedPixels - 1;
  EXPECT_FALSE(measure(estimate, truth).posture_rms_observed_deg);
}

TEST(MeasureFrame, PixelsOfSeveralPatchesAddUp) {
  FrameTruth truth = make_truth();
  truth.visible_pixels.fill(0);
  truth.visible_pixels[kIndexProximal] = truth.visible_pixels[kIndexDistal] = kObservedPixels / 2;
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexMcpFlexion] += radians_from_degrees(10);  // moves both; only MCP's two angles do
  EXPECT_NEAR(*measure(estimate, truth).posture_rms_observed_deg, 10 / std::sqrt(2.0), kRounding);
}

TEST(MeasureFrame, CoverageEndsAt50MillimetresAnd30Degrees) {
  const auto covered = [](double mm, double degrees) {
    TrackResult estimate = make_estimate();
    estimate.T_camera_hand.translation().z() += mm / 1000;
    estimate.T_camera_hand.linear() =
        estimate.T_camera_hand.linear() *
        Eigen::AngleAxisd(radians_from_degrees(degrees), Eigen::Vector3d::UnitX()).toRotationMatrix();
    const reports::FrameRecord record = measure(estimate);
    EXPECT_NE(record.covered, record.false_tracked) << "a tracked frame is one or the other";
    return record.covered;
  };
  EXPECT_TRUE(covered(49.9, 29.9));
  EXPECT_FALSE(covered(50.1, 0));
  EXPECT_FALSE(covered(0, 30.1));
}

TEST(MeasureFrame, LostFrameHasNoErrors) {
  TrackResult estimate = make_estimate();
  estimate.status = TrackStatus::poor_match;
  estimate.matches = {Match{.entry = 3, .error = 1.5F}};
  const FrameErrors errors = measure_frame(0, estimate, make_truth(), hand());
  EXPECT_TRUE(errors.joint_errors_mm.empty());
  EXPECT_FALSE(errors.record.covered || errors.record.false_tracked);
  EXPECT_TRUE(errors.record.false_lost) << "the hand was there";
  for (const reports::Metric& metric : reports::metrics()) {
    const bool has_value = (errors.record.*metric.value).has_value();
    EXPECT_EQ(has_value, metric.key == "matching_error_px") << metric.key;
  }
  FrameTruth out_of_view = make_truth();
  out_of_view.trackable = false;
  EXPECT_FALSE(measure(estimate, out_of_view).false_lost);
}

TEST(MeasureFrame, NonFiniteInputIsABrokenInvariant) {
  const auto expect_refused = [](const auto& damage) {
    TrackResult estimate = make_estimate();
    FrameTruth truth = make_truth();
    damage(estimate, truth);
    EXPECT_THROW(measure(estimate, truth), std::logic_error);
  };
  expect_refused([](TrackResult& r, FrameTruth&) { r.posture[3] = kNaN; });
  expect_refused([](TrackResult& r, FrameTruth&) { r.posture_unfiltered[3] = kNaN; });
  expect_refused([](TrackResult& r, FrameTruth&) { r.T_camera_hand.translation().x() = kNaN; });
  expect_refused([](TrackResult& r, FrameTruth&) { r.icp_residual = std::numeric_limits<double>::infinity(); });
  expect_refused([](TrackResult&, FrameTruth& t) { t.posture[0] = kNaN; });
  expect_refused([](TrackResult&, FrameTruth& t) { t.T_camera_hand.translation().z() = kNaN; });
}

TEST(CountPatches, CountsFromPatchPlusOne) {
  Image<uint8_t> image(4, 1);
  image(1, 0) = kThumbProximal + 1;
  image(2, 0) = image(3, 0) = kCuff + 1;
  const std::array<int, kPatchCount> counts = count_patches(image);
  EXPECT_EQ(counts[kThumbProximal], 1);
  EXPECT_EQ(counts[kCuff], 2);
  EXPECT_EQ(counts[kThumbDistal], 0);
  EXPECT_THAT(count_patches({}), testing::Each(0));
}

TEST(RotationError, IsTheGeodesicAngle) {
  const Eigen::Matrix3d a = some_pose().linear();
  for (const double degrees : {0.0, 1e-3, 90.0, 179.0}) {
    const Eigen::AngleAxisd turn(radians_from_degrees(degrees), Eigen::Vector3d(1, -2, 3).normalized());
    EXPECT_NEAR(rotation_error_deg(a, a * turn.toRotationMatrix()), degrees, kRounding);
  }
}

// Sequences.

struct Sequence {
  std::vector<TrackResult> estimates;
  std::vector<TrajectoryFrame> truth;
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

/// The index finger bends to and fro by 40 degrees; the estimate is the truth `delay` frames before.
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
  for (TrackResult& estimate : s.estimates) {
    for (int axis = 0; axis < 3; ++axis) estimate.T_camera_hand.translation()[axis] += 0.001 * random.normal();
  }
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
  for (size_t i = 1; i < s.truth.size(); ++i) {
    s.estimates[i].posture = 0.75 * s.estimates[i - 1].posture + 0.25 * s.truth[i].posture;
  }
  // x = 0.75 x + 0.25 new delays a slow movement by 3 frames, and a sine of 0.2 rad a frame by this. The distance
  // is no parabola (the filter also flattens the sine), and the filter starts at rest.
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
