#include <gtest/gtest.h>

#include "core/base/math.h"
#include "reports/metrics/example_frame.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

/// Metric of an estimate that differs from the truth, for a hand at rest 0.7 m in front of the camera.
std::optional<double> palm_error(const std::function<void(TrackResult&)>& change) {
  FrameTruth truth;
  truth.T_camera_hand = Eigen::Translation3d(0.05, 0, 0.7);
  truth.T_hand_joint = example_hand().pose(truth.posture).T_hand_joint;
  TrackResult estimate;
  estimate.status = TrackStatus::tracked;
  estimate.T_camera_hand = truth.T_camera_hand;
  change(estimate);
  return measure_frame(0, estimate, truth, example_hand()).record["palm_error_mm"];
}

TEST(PalmMetrics, OnlyThePoseCounts) {
  EXPECT_NEAR(palm_error([](TrackResult&) {}).value(), 0, 1e-9);
  const auto bend = [](TrackResult& estimate) {
    for (int a = 0; a < kAngleCount; ++a) estimate.posture[a] = 0.2;
  };
  EXPECT_NEAR(palm_error(bend).value(), 0, 1e-9) << "whatever thumb, fingers and wrist do";
  const auto move = [](TrackResult& estimate) {
    estimate.T_camera_hand.pretranslate(Eigen::Vector3d(0.003, -0.004, 0.012));
  };
  EXPECT_NEAR(palm_error(move).value(), 13, 1e-9);
  EXPECT_FALSE(palm_error([](TrackResult& estimate) { estimate.status = TrackStatus::poor_match; }));
}

TEST(PalmMetrics, ATurnCountsByTheChordsOfWristAndKnuckles) {
  const double angle = radians_from_degrees(10);
  const auto turn = [&](TrackResult& estimate) {
    estimate.T_camera_hand.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
  };
  double sum = 0;
  for (const char* name : {"wrist", "index-finger-phalanx-proximal", "middle-finger-phalanx-proximal",
                           "ring-finger-phalanx-proximal", "pinky-finger-phalanx-proximal"}) {
    const Eigen::Vector3d p = example_hand().pose(Posture::Zero()).T_hand_joint[joint_index(name)].translation();
    sum += 1000 * 2 * std::sin(angle / 2) * std::hypot(p.x(), p.z());
  }
  EXPECT_NEAR(palm_error(turn).value(), sum / 5, 1e-9);
}

}  // namespace
}  // namespace glovebench::reports
