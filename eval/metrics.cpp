#include "eval/metrics.h"

#include "core/base/angles.h"
#include "core/base/check.h"

namespace glovebench::eval {
namespace {

using reports::FrameRecord;

constexpr double kRestPosition = 0.001;                   // m a frame
constexpr double kRestAngle = radians_from_degrees(0.5);  // a frame
constexpr int kMinRestSteps = 10;
constexpr int kMaxLatency = 10;  // frames
constexpr double kMovingPosture = radians_from_degrees(10);

using Chosen = std::array<bool, kAngleCount>;

/// Root mean square of the chosen angles, degrees; empty if none is chosen.
std::optional<double> rms_deg(const Posture& difference, const Chosen& chosen) {
  double sum = 0;
  int count = 0;
  for (int a = 0; a < kAngleCount; ++a) {
    if (!chosen[a]) continue;
    sum += difference[a] * difference[a];
    ++count;
  }
  if (count == 0) return {};
  return degrees_from_radians(std::sqrt(sum / count));
}

std::optional<double> mean_abs_deg(const Posture& difference, const Chosen& chosen) {
  double sum = 0;
  int count = 0;
  for (int a = 0; a < kAngleCount; ++a) {
    if (!chosen[a]) continue;
    sum += std::abs(difference[a]);
    ++count;
  }
  if (count == 0) return {};
  return degrees_from_radians(sum / count);
}

Chosen all_angles() {
  Chosen chosen;
  chosen.fill(true);
  return chosen;
}

Chosen without_wrist() {
  Chosen chosen = all_angles();
  chosen[kWristFlexion] = chosen[kWristAbduction] = false;
  return chosen;
}

Chosen observed_angles(const std::array<int, kPatchCount>& visible_pixels) {
  Chosen observed;
  for (int a = 0; a < kAngleCount; ++a) {
    int pixels = 0;
    for (int p = 0; p < kPatchCount; ++p) {
      if (patches_moved()[a] >> p & 1) pixels += visible_pixels[p];
    }
    observed[a] = pixels >= kObservedPixels;
  }
  return observed;
}

Chosen opposite(Chosen chosen) {
  for (bool& c : chosen) c = !c;
  return chosen;
}

void measure_posture(FrameRecord& record, const TrackResult& estimate, const FrameTruth& truth) {
  const Posture difference = estimate.posture - truth.posture;
  const Chosen observed = observed_angles(truth.visible_pixels);
  record.posture_rms_deg = rms_deg(difference, all_angles());
  record.posture_mean_abs_deg = mean_abs_deg(difference, all_angles());
  record.posture_rms_without_wrist_deg = rms_deg(difference, without_wrist());
  record.posture_mean_abs_without_wrist_deg = mean_abs_deg(difference, without_wrist());
  record.posture_rms_observed_deg = rms_deg(difference, observed);
  record.posture_rms_hidden_deg = rms_deg(difference, opposite(observed));
  record.posture_rms_unfiltered_deg = rms_deg(estimate.posture_unfiltered - truth.posture, all_angles());
}

double mean_vertex_error_mm(const HandModel& model, const TrackResult& estimate, const PosedHand& estimated,
                            const FrameTruth& truth) {
  const PosedHand true_hand = model.pose(truth.posture);
  double sum = 0;
  for (size_t v = 0; v < estimated.vertices.size(); ++v) {
    sum += (estimate.T_camera_hand * estimated.vertices[v].cast<double>() -
            truth.T_camera_hand * true_hand.vertices[v].cast<double>())
               .norm();
  }
  return 1000 * sum / static_cast<double>(estimated.vertices.size());
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

void check_finite(const TrackResult& estimate, const FrameTruth& truth) {
  check(estimate.posture.allFinite() && estimate.posture_unfiltered.allFinite() &&
            estimate.T_camera_hand.matrix().allFinite() && std::isfinite(estimate.icp_residual),
        "a tracked frame's posture, pose and residual are finite");
  check(truth.posture.allFinite() && truth.T_camera_hand.matrix().allFinite(), "a truth is finite");
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

bool at_rest(const trajectories::TrajectoryFrame& a, const trajectories::TrajectoryFrame& b) {
  const double turn = radians_from_degrees(rotation_error_deg(a.T_camera_hand.linear(), b.T_camera_hand.linear()));
  return (a.T_camera_hand.translation() - b.T_camera_hand.translation()).norm() < kRestPosition &&
         turn < kRestAngle && posture_distance(a.posture, b.posture) < kRestAngle;
}

/// Sum over the tracked frames of the distance of the estimated posture from the truth `delay` frames earlier.
double delayed_distance(std::span<const TrackResult> estimates,
                        std::span<const trajectories::TrajectoryFrame> truth, int delay) {
  double sum = 0;
  for (size_t i = kMaxLatency; i < truth.size(); ++i) {
    if (estimates[i].status != TrackStatus::tracked) continue;  // its posture is an older frame's
    sum += posture_distance(estimates[i].posture, truth[i - delay].posture);
  }
  return sum;
}

int tracked_count(std::span<const TrackResult> estimates) {
  return static_cast<int>(std::count_if(estimates.begin(), estimates.end(),
                                        [](const TrackResult& r) { return r.status == TrackStatus::tracked; }));
}

std::optional<double> latency_frames(std::span<const TrackResult> estimates,
                                     std::span<const trajectories::TrajectoryFrame> truth) {
  if (truth.size() < 3 * kMaxLatency || tracked_count(estimates.subspan(kMaxLatency)) < kMaxLatency) return {};
  double moved = 0;
  for (const auto& frame : truth) moved = std::max(moved, posture_distance(frame.posture, truth[0].posture));
  if (moved < kMovingPosture) return {};
  std::vector<double> distances;
  for (int delay = 0; delay <= kMaxLatency; ++delay) distances.push_back(delayed_distance(estimates, truth, delay));
  const int best = static_cast<int>(std::min_element(distances.begin(), distances.end()) - distances.begin());
  if (best == 0 || best == kMaxLatency) return best;
  const double before = distances[best - 1], after = distances[best + 1];
  const double bend = before - 2 * distances[best] + after;
  return bend > 0 ? best + 0.5 * (before - after) / bend : best;
}

}  // namespace

std::array<int, kPatchCount> count_patches(const Image<uint8_t>& patch_image) {
  std::array<int, kPatchCount> counts{};
  for (const uint8_t patch : patch_image) {
    if (patch > 0) ++counts[patch - 1];
  }
  return counts;
}

double rotation_error_deg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return degrees_from_radians(Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b)));
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
  if (!estimate.matches.empty()) record.matching_error_px = estimate.matches[0].error;
  if (estimate.status != TrackStatus::tracked) {
    record.false_lost = truth.trackable;
    return errors;
  }
  check_finite(estimate, truth);
  if (estimate.icp_points > 0) record.icp_residual_mm = 1000 * estimate.icp_residual;
  record.position_error_mm =
      1000 * (estimate.T_camera_hand.translation() - truth.T_camera_hand.translation()).norm();
  record.rotation_error_deg = rotation_error_deg(estimate.T_camera_hand.linear(), truth.T_camera_hand.linear());
  record.covered =
      record.position_error_mm < kCoveredPosition_mm && record.rotation_error_deg < kCoveredRotation_deg;
  record.false_tracked = !record.covered;
  measure_posture(record, estimate, truth);

  const PosedHand estimated = tracker_model.pose(estimate.posture);
  record.vertex_error_mm = mean_vertex_error_mm(tracker_model, estimate, estimated, truth);
  errors.joint_errors_mm = joint_errors_mm(estimate, estimated, truth);
  record.joint_error_mm = mean_of(errors.joint_errors_mm);
  std::vector<double> tips;
  for (const int tip : fingertip_joints()) tips.push_back(errors.joint_errors_mm[tip]);
  record.fingertip_error_mm = mean_of(tips);
  return errors;
}

reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates,
                                          std::span<const trajectories::TrajectoryFrame> truth) {
  check(estimates.size() == truth.size(), "an estimate for each frame of the truth");
  reports::SequenceMetrics metrics;
  double position = 0, rotation = 0;
  int steps = 0;
  for (size_t i = 1; i < truth.size(); ++i) {
    const TrackResult &a = estimates[i - 1], &b = estimates[i];
    if (a.status != TrackStatus::tracked || b.status != TrackStatus::tracked || !at_rest(truth[i - 1], truth[i])) {
      continue;
    }
    const Eigen::Isometry3d error_a = a.T_camera_hand * truth[i - 1].T_camera_hand.inverse();
    const Eigen::Isometry3d error_b = b.T_camera_hand * truth[i].T_camera_hand.inverse();
    const Eigen::Vector3d move = (b.T_camera_hand.translation() - truth[i].T_camera_hand.translation()) -
                                 (a.T_camera_hand.translation() - truth[i - 1].T_camera_hand.translation());
    position += move.squaredNorm();
    rotation += std::pow(rotation_error_deg(error_a.linear(), error_b.linear()), 2);
    ++steps;
  }
  if (steps >= kMinRestSteps) {
    metrics.jitter_position_mm = 1000 * std::sqrt(position / steps);
    metrics.jitter_rotation_deg = std::sqrt(rotation / steps);
  }
  metrics.latency_frames = latency_frames(estimates, truth);
  return metrics;
}

}  // namespace glovebench::eval
