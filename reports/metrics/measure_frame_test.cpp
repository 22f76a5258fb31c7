#include "reports/metrics/measure_frame.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/base/math.h"
#include "core/hand/skeleton.h"
#include "reports/metrics/coverage.h"
#include "reports/metrics/example_frame.h"

namespace glovebench::reports {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Of a value computed in doubles from meters and radians.
constexpr double kRounding = 1e-6;

FrameTruth make_truth() {
  FrameTruth truth = example_truth();
  truth.visible_pixels.fill(1000);
  truth.trackable = true;
  return truth;
}

FrameRecord measure(const TrackResult& estimate, const FrameTruth& truth = make_truth()) {
  return measure_frame(7, estimate, truth, example_hand()).record;
}

TEST(MeasureFrame, PerfectEstimateHasNoError) {
  const FrameRecord record = measure(make_estimate());
  EXPECT_EQ(record.frame, 7);
  EXPECT_EQ(record.timestamp_us, 66667);
  EXPECT_TRUE(record.covered);
  EXPECT_FALSE(record.false_tracked || record.false_lost);
  for (const auto& error : {record["position_error_mm"], record["rotation_error_deg"], record["posture_rms_deg"],
                            record["posture_mean_abs_deg"], record["posture_rms_unfiltered_deg"],
                            record["vertex_error_mm"], record["joint_error_mm"], record["fingertip_error_mm"]}) {
    EXPECT_NEAR(error.value(), 0, kRounding);
  }
  EXPECT_FALSE(record["matching_error_px"]) << "no match, no matching error";
  EXPECT_FALSE(record["posture_rms_hidden_deg"]) << "no joint is hidden";
  EXPECT_FALSE(record["icp_residual_mm"]) << "a method without alignment has no residual";
}

TEST(MeasureFrame, AnAlignmentHasAResidual) {
  TrackResult estimate = make_estimate();
  estimate.icp_points = 3;
  estimate.icp_residual = 0.002;
  EXPECT_NEAR(measure(estimate)["icp_residual_mm"].value(), 2, kRounding);
}

TEST(MeasureFrame, TranslationMovesEveryPointAlike) {
  TrackResult estimate = make_estimate();
  estimate.T_camera_hand.translation() += Eigen::Vector3d(0.003, -0.004, 0.012);
  const FrameRecord record = measure(estimate);
  for (const auto& error : {record["position_error_mm"], record["vertex_error_mm"], record["joint_error_mm"],
                            record["fingertip_error_mm"]}) {
    EXPECT_NEAR(error.value(), 13, 1e-4) << "3-4-12-13; vertices are floats of under 0.2 m";
  }
  EXPECT_NEAR(*record["rotation_error_deg"], 0, kRounding);
  EXPECT_NEAR(*record["posture_rms_deg"], 0, kRounding);
}

TEST(MeasureFrame, RotationAboutTheHandsOriginMovesPointsByTheChord) {
  const double angle = radians_from_degrees(10);
  TrackResult estimate = make_estimate();
  estimate.T_camera_hand.linear() =
      estimate.T_camera_hand.linear() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const FrameErrors errors = measure_frame(0, estimate, make_truth(), example_hand());
  EXPECT_NEAR(*errors.record["rotation_error_deg"], 10, kRounding);
  EXPECT_NEAR(*errors.record["position_error_mm"], 0, kRounding);
  const JointPoses& joints = make_truth().T_hand_joint;
  ASSERT_EQ(errors.joint_errors_mm.size(), static_cast<size_t>(kForearmJoint));
  double tips = 0;
  for (const int tip : fingertip_joints()) {
    const Eigen::Vector3d p = joints[tip].translation();
    const double chord_mm = 1000 * 2 * std::sin(angle / 2) * std::hypot(p.x(), p.z());
    EXPECT_NEAR(*errors.joint_errors_mm[tip], chord_mm, kRounding) << joint_name(tip);
    tips += chord_mm / 5;
  }
  EXPECT_NEAR(*errors.record["fingertip_error_mm"], tips, kRounding);
}

TEST(MeasureFrame, OneJointMovesOnlyWhatHangsOnIt) {
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexPipFlexion] += radians_from_degrees(22);
  const FrameErrors errors = measure_frame(0, estimate, make_truth(), example_hand());
  const FrameRecord& record = errors.record;
  EXPECT_NEAR(*record["posture_rms_deg"], 22 / std::sqrt(22.0), kRounding);
  EXPECT_NEAR(*record["posture_mean_abs_deg"], 1, kRounding);
  EXPECT_NEAR(*record["posture_rms_without_wrist_deg"], 22 / std::sqrt(20.0), kRounding);
  EXPECT_NEAR(*record["posture_mean_abs_without_wrist_deg"], 1.1, kRounding);
  EXPECT_NEAR(*record["posture_rms_unfiltered_deg"], 0, kRounding) << "only the smoothed posture is wrong";
  EXPECT_NEAR(*record["position_error_mm"], 0, kRounding);
  EXPECT_GT(*record["vertex_error_mm"], 0.1);
  for (int joint = 0; joint < kForearmJoint; ++joint) {
    const bool moved =
        joint == joint_index("index-finger-phalanx-distal") || joint == joint_index("index-finger-tip");
    if (moved) {
      EXPECT_GT(*errors.joint_errors_mm[joint], 5) << joint_name(joint);
    } else {
      EXPECT_NEAR(*errors.joint_errors_mm[joint], 0, kRounding) << joint_name(joint);
    }
  }
}

TEST(MeasureFrame, WristStandsApart) {
  TrackResult estimate = make_estimate();
  estimate.posture[kWristFlexion] -= radians_from_degrees(22);
  const FrameRecord record = measure(estimate);
  EXPECT_NEAR(*record["posture_mean_abs_deg"], 1, kRounding);
  EXPECT_NEAR(*record["posture_rms_without_wrist_deg"], 0, kRounding);
  EXPECT_NEAR(*record["joint_error_mm"], 0, kRounding) << "the forearm is no keypoint";
  EXPECT_GT(*record["vertex_error_mm"], 0.01) << "the cuff moves";
}

TEST(MeasureFrame, SplitsThePostureIntoObservedAndHidden) {
  FrameTruth truth = make_truth();
  truth.visible_pixels.fill(0);
  truth.visible_pixels[kIndexDistal] = kObservedPixels;  // moved by the index finger's four angles
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexDipFlexion] += radians_from_degrees(10);
  estimate.posture[kRingPipFlexion] -= radians_from_degrees(20);
  const FrameRecord record = measure(estimate, truth);
  EXPECT_NEAR(*record["posture_rms_observed_deg"], 10 / std::sqrt(4.0), kRounding);
  EXPECT_NEAR(*record["posture_rms_hidden_deg"], 20 / std::sqrt(18.0), kRounding);

  truth.visible_pixels[kIndexDistal] = kObservedPixels - 1;
  EXPECT_FALSE(measure(estimate, truth)["posture_rms_observed_deg"]);
}

TEST(MeasureFrame, PixelsOfSeveralPatchesAddUp) {
  FrameTruth truth = make_truth();
  truth.visible_pixels.fill(0);
  truth.visible_pixels[kIndexProximal] = truth.visible_pixels[kIndexDistal] = kObservedPixels / 2;
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexMcpFlexion] += radians_from_degrees(10);  // only MCP's two angles move both patches
  EXPECT_NEAR(*measure(estimate, truth)["posture_rms_observed_deg"], 10 / std::sqrt(2.0), kRounding);
}

TEST(MeasureFrame, CoverageEndsAt50MillimetresAnd30Degrees) {
  const auto covered = [](double mm, double degrees) {
    TrackResult estimate = make_estimate();
    estimate.T_camera_hand.translation().z() += mm / 1000;
    estimate.T_camera_hand.linear() =
        estimate.T_camera_hand.linear() *
        Eigen::AngleAxisd(radians_from_degrees(degrees), Eigen::Vector3d::UnitX()).toRotationMatrix();
    const FrameRecord record = measure(estimate);
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
  const FrameErrors errors = measure_frame(0, estimate, make_truth(), example_hand());
  EXPECT_TRUE(errors.joint_errors_mm.empty());
  EXPECT_FALSE(errors.record.covered || errors.record.false_tracked);
  EXPECT_TRUE(errors.record.false_lost) << "the hand was there";
  for (const Metric& metric : frame_metrics())
    EXPECT_EQ(errors.record[metric.key].has_value(), metric.key == "matching_error_px") << metric.key;
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

/// The true joints, as a tracker without our hand model gives them.
TrackResult joints_alone() {
  TrackResult estimate = make_estimate();
  estimate.has = {.posture = false, .pose = false, .internals = false};
  const FrameTruth truth = make_truth();
  for (int j = 0; j < kForearmJoint; ++j)
    estimate.joints.emplace_back(truth.T_camera_hand * truth.T_hand_joint[j].translation());
  return estimate;
}

std::set<std::string_view> measured_metrics(const FrameRecord& record) {
  std::set<std::string_view> keys;
  for (const Metric& metric : frame_metrics())
    if (metric.of_tracked && record[metric.key]) keys.insert(metric.key);
  return keys;
}

TEST(MeasureFrame, JointsAloneHaveNeitherPostureNorPose) {
  TrackResult estimate = joints_alone();
  FrameRecord record = measure(estimate);
  EXPECT_THAT(measured_metrics(record),
              testing::UnorderedElementsAre("fingertip_error_mm", "joint_error_mm", "mpjpe_root_mm",
                                            "mpjpe_scaled_mm", "mpjpe_procrustes_mm", "palm_error_mm"));
  EXPECT_NEAR(*record["joint_error_mm"], 0, kRounding);
  EXPECT_FALSE(record.is_judged || record.covered || record.false_tracked);
  const Coverage coverage = count_coverage({{1, {record}}});
  EXPECT_FALSE(coverage.share() || coverage.found_share() || coverage.usable_share());

  estimate.joints[kWristJoint].reset();
  record = measure(estimate);
  EXPECT_THAT(measured_metrics(record),
              testing::UnorderedElementsAre("fingertip_error_mm", "joint_error_mm", "mpjpe_procrustes_mm"))
      << "without a wrist nothing is relative to it";
}

TEST(MeasureFrame, JointsWithoutPlaceOrScaleHaveFewerMetrics) {
  TrackResult estimate = joints_alone();
  for (auto& joint : estimate.joints) *joint = 2 * *joint + Eigen::Vector3d(1, 2, 3);
  estimate.has.place = false;
  EXPECT_THAT(measured_metrics(measure(estimate)),
              testing::UnorderedElementsAre("mpjpe_root_mm", "mpjpe_scaled_mm", "mpjpe_procrustes_mm"));
  estimate.has.scale = false;
  const FrameRecord record = measure(estimate);
  EXPECT_THAT(measured_metrics(record), testing::UnorderedElementsAre("mpjpe_scaled_mm", "mpjpe_procrustes_mm"));
  EXPECT_NEAR(*record["mpjpe_scaled_mm"], 0, kRounding);
  EXPECT_NEAR(*record["mpjpe_procrustes_mm"], 0, kRounding);
}

TEST(MeasureFrame, APoseAloneIsNeitherUsableNorUnusable) {
  TrackResult estimate = make_estimate();
  estimate.has.posture = estimate.has.internals = false;
  const FrameRecord record = measure(estimate);
  EXPECT_THAT(measured_metrics(record), testing::UnorderedElementsAre("position_error_mm", "rotation_error_deg"));
  EXPECT_TRUE(record.covered);
  EXPECT_EQ(is_usable(record), std::nullopt);
}

}  // namespace
}  // namespace glovebench::reports
