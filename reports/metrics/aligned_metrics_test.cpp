#include <gtest/gtest.h>

#include "core/base/math.h"
#include "reports/metrics/example_frame.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

/// Of values computed in doubles; vertices are floats.
constexpr double kRoundingOfJoints_mm = 1e-9, kRoundingOfVertices_mm = 1e-3;

TEST(AlignedMetrics, ATranslationIsAlignedAway) {
  TrackResult estimate = make_estimate();
  estimate.T_camera_hand.pretranslate(Eigen::Vector3d(0.003, -0.004, 0.012));
  const FrameRecord record = measure_frame(0, estimate, example_truth(), example_hand()).record;
  EXPECT_NEAR(*record["joint_error_mm"], 13, kRoundingOfJoints_mm);
  for (const char* metric : {"mpjpe_root_mm", "mpjpe_scaled_mm", "mpjpe_procrustes_mm"})
    EXPECT_NEAR(*record[metric], 0, kRoundingOfJoints_mm) << metric;
  for (const char* metric : {"mpvpe_root_mm", "mpvpe_procrustes_mm"})
    EXPECT_NEAR(*record[metric], 0, kRoundingOfVertices_mm) << metric;
}

TEST(AlignedMetrics, ATurnRemainsUnlessRotationsAreAligned) {
  const double angle = radians_from_degrees(10);
  TrackResult estimate = make_estimate();
  estimate.T_camera_hand.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
  const FrameTruth truth = example_truth();
  const FrameRecord record = measure_frame(0, estimate, truth, example_hand()).record;
  double chords_mm = 0;
  for (int j = 0; j < kForearmJoint; ++j) {
    const Eigen::Vector3d p = truth.T_hand_joint[j].translation() - truth.T_hand_joint[kWristJoint].translation();
    chords_mm += 1000 * 2 * std::sin(angle / 2) * std::hypot(p.x(), p.z());
  }
  EXPECT_NEAR(*record["mpjpe_root_mm"], chords_mm / kForearmJoint, kRoundingOfJoints_mm);
  EXPECT_NEAR(*record["mpjpe_scaled_mm"], chords_mm / kForearmJoint, kRoundingOfJoints_mm) << "one size";
  EXPECT_NEAR(*record["mpjpe_procrustes_mm"], 0, kRoundingOfJoints_mm);
  EXPECT_GT(*record["mpvpe_root_mm"], 5);
  EXPECT_NEAR(*record["mpvpe_procrustes_mm"], 0, kRoundingOfVertices_mm);
}

TEST(AlignedMetrics, AHandOfAnotherSizeRemainsUnlessScalesAreAligned) {
  FrameTruth truth = example_truth();
  double distances_mm = 0;
  const Eigen::Vector3d wrist = truth.T_hand_joint[kWristJoint].translation();
  for (Eigen::Isometry3d& joint : truth.T_hand_joint) joint.translation() *= 1.1;
  for (int j = 0; j < kForearmJoint; ++j)
    distances_mm += 1000 * 0.1 * (truth.T_hand_joint[j].translation() / 1.1 - wrist).norm();
  const FrameRecord record = measure_frame(0, make_estimate(), truth, example_hand()).record;
  EXPECT_NEAR(*record["mpjpe_root_mm"], distances_mm / kForearmJoint, kRoundingOfJoints_mm);
  EXPECT_NEAR(*record["mpjpe_scaled_mm"], 0, kRoundingOfJoints_mm);
  EXPECT_NEAR(*record["mpjpe_procrustes_mm"], 0, kRoundingOfJoints_mm);
}

TEST(AlignedMetrics, ABentFingerRemainsInAll) {
  TrackResult estimate = make_estimate();
  estimate.posture[kIndexPipFlexion] += radians_from_degrees(40);
  const FrameErrors errors = measure_frame(0, estimate, example_truth(), example_hand());
  const FrameRecord& record = errors.record;
  EXPECT_NEAR(*record["mpjpe_root_mm"], *record["joint_error_mm"], kRoundingOfJoints_mm) << "the wrists are one";
  EXPECT_GT(*record["mpjpe_procrustes_mm"], 0.5);
  // It has the least squares, so its mean is below the root mean square without it, not below the mean.
  std::vector<double> joints_mm;
  for (const auto& error : errors.joint_errors_mm) joints_mm.push_back(*error);
  EXPECT_LT(*record["mpjpe_procrustes_mm"], *rms(joints_mm));
  EXPECT_NEAR(*record["mpvpe_root_mm"], *record["vertex_error_mm"], kRoundingOfVertices_mm);
  EXPECT_GT(*record["mpvpe_procrustes_mm"], 0.1);
}

}  // namespace
}  // namespace glovebench::reports
