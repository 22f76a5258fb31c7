#include "reports/metrics/measure_frame.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/math.h"
#include "reports/metrics/coverage.h"

namespace glovebench::reports {
namespace {

void check_finite(const TrackResult& estimate, const FrameTruth& truth) {
  check(estimate.posture.allFinite() && estimate.posture_unfiltered.allFinite() &&
            estimate.T_camera_hand.matrix().allFinite() && std::isfinite(estimate.icp_residual),
        "a tracked frame's posture, pose and residual are finite");
  check(truth.posture.allFinite() && truth.T_camera_hand.matrix().allFinite(), "a truth is finite");
}

std::vector<double> joint_errors_mm(const TrackResult& estimate, const PosedHand& estimated,
                                    const FrameTruth& truth) {
  std::vector<double> errors;
  for (int j = 0; j < kForearmJoint; ++j) {
    const Eigen::Vector3d a = estimate.T_camera_hand * estimated.T_hand_joint[j].translation();
    const Eigen::Vector3d b = truth.T_camera_hand * truth.T_hand_joint[j].translation();
    errors.push_back(1000 * (a - b).norm());
  }
  return errors;
}

MeasuredFrame measured(const TrackResult& estimate, const FrameTruth& truth, const HandModel& model) {
  check_finite(estimate, truth);
  MeasuredFrame frame{estimate, truth, model.pose(estimate.posture), model.pose(truth.posture), {}};
  frame.joint_errors_mm = joint_errors_mm(estimate, frame.estimated_hand, truth);
  return frame;
}

}  // namespace

FrameErrors measure_frame(int frame, const TrackResult& estimate, const FrameTruth& truth,
                          const HandModel& tracker_model) {
  FrameErrors errors;
  FrameRecord& record = errors.record;
  record.frame = frame;
  record.timestamp_us = estimate.timestamp_us;
  record.status = estimate.status;
  record.ambiguous = estimate.ambiguous;
  record.converged = estimate.converged;
  record.icp_iterations = estimate.icp_iterations;
  for (const Metric& metric : frame_metrics())
    if (metric.of_any) record[metric.key] = metric.of_any(estimate, truth);
  if (estimate.status != TrackStatus::tracked) {
    record.false_lost = truth.trackable;
    return errors;
  }
  MeasuredFrame tracked = measured(estimate, truth, tracker_model);
  for (const Metric& metric : frame_metrics())
    if (metric.of_tracked) record[metric.key] = metric.of_tracked(tracked);
  record.covered =
      record["position_error_mm"] < kFoundPosition_mm && record["rotation_error_deg"] < kFoundRotation_deg;
  record.false_tracked = !record.covered;
  errors.joint_errors_mm = std::move(tracked.joint_errors_mm);
  return errors;
}

std::array<int, kPatchCount> count_patches(const Image<uint8_t>& patch_image) {
  std::array<int, kPatchCount> counts{};
  for (const uint8_t patch : patch_image) {
    if (patch > 0) ++counts[patch - 1];
  }
  return counts;
}

}  // namespace glovebench::reports
