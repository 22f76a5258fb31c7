#include "reports/metrics/measure_frame.h"

#include <cmath>

#include "core/base/error.h"
#include "reports/metrics/coverage.h"

namespace glovebench::reports {
namespace {

void check_finite(const TrackResult& estimate, const FrameTruth& truth) {
  check(estimate.posture.allFinite() && estimate.posture_unfiltered.allFinite() &&
            estimate.T_camera_hand.matrix().allFinite() && std::isfinite(estimate.icp_residual),
        "a tracked frame's posture, pose and residual are finite");
  check(truth.posture.allFinite() && truth.T_camera_hand.matrix().allFinite(), "a truth is finite");
}

bool has(const TrackResult& estimate, Needs needs) {
  const EstimateParts& parts = estimate.has;
  const bool joints = parts.hand() || !estimate.joints.empty();
  switch (needs) {
    case Needs::hand:
      return parts.hand();
    case Needs::posture:
      return parts.posture;
    case Needs::pose:
      return parts.pose;
    case Needs::joints:
      return joints;
    case Needs::joints_to_scale:
      return joints && parts.scale;
    case Needs::joints_in_camera:
      return joints && parts.scale && parts.place;
    case Needs::internals:
      return parts.internals;
  }
  return false;
}

void add_joints(MeasuredFrame& frame) {
  const TrackResult& estimate = frame.estimate;
  for (int j = 0; j < kForearmJoint; ++j) {
    std::optional<Eigen::Vector3d> joint;
    if (!estimate.joints.empty())
      joint = estimate.joints[j];
    else if (estimate.has.hand())
      joint = estimate.T_camera_hand * frame.estimated_hand.T_hand_joint[j].translation();
    frame.joints.push_back(joint);
    frame.true_joints.push_back(frame.truth.T_camera_hand * frame.truth.T_hand_joint[j].translation());
    frame.joint_errors_mm.emplace_back();
    if (joint && has(estimate, Needs::joints_in_camera))
      frame.joint_errors_mm.back() = 1000 * (*joint - frame.true_joints.back()).norm();
  }
}

MeasuredFrame measured(const TrackResult& estimate, const FrameTruth& truth, const HandModel& model) {
  check_finite(estimate, truth);
  MeasuredFrame frame{estimate, truth, model.pose(estimate.posture), model.pose(truth.posture), {}, {}, {}};
  add_joints(frame);
  return frame;
}

}  // namespace

std::optional<double> mean_error_mm(const MeasuredFrame& frame, std::span<const int> joints) {
  double sum = 0;
  for (const int joint : joints) {
    if (!frame.joint_errors_mm[joint]) return {};
    sum += *frame.joint_errors_mm[joint];
  }
  return sum / static_cast<double>(joints.size());
}

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
  record.is_judged = estimate.has.pose;
  for (const Metric& metric : frame_metrics())
    if (metric.of_any) record[metric.key] = metric.of_any(estimate, truth);
  if (estimate.status != TrackStatus::tracked) {
    record.false_lost = truth.trackable;
    return errors;
  }
  MeasuredFrame tracked = measured(estimate, truth, tracker_model);
  for (const Metric& metric : frame_metrics())
    if (metric.of_tracked && has(estimate, metric.needs)) record[metric.key] = metric.of_tracked(tracked);
  if (record.is_judged) {
    record.covered =
        record["position_error_mm"] < kFoundPosition_mm && record["rotation_error_deg"] < kFoundRotation_deg;
    record.false_tracked = !record.covered;
  }
  errors.joint_errors_mm = std::move(tracked.joint_errors_mm);
  return errors;
}

std::array<int, kPatchCount> count_patches(const Image<uint8_t>& patch_image) {
  std::array<int, kPatchCount> counts{};
  for (const uint8_t patch : patch_image)
    if (patch > 0) ++counts[patch - 1];
  return counts;
}

}  // namespace glovebench::reports
