#include "eval/measured_run.h"

#include "core/base/error.h"
#include "core/base/math.h"
#include "eval/threads.h"

namespace glovebench::eval {
namespace {

constexpr double kRestPosition = 0.001;                   // m per frame
constexpr double kRestAngle = radians_from_degrees(0.5);  // per frame
constexpr int kMinRestSteps = 10;
constexpr int kMaxLatency = 10;  // frames
constexpr double kMovingPosture = radians_from_degrees(10);

bool at_rest(const HandFrame& a, const HandFrame& b) {
  const double turn = angle_between(a.T_camera_hand.linear(), b.T_camera_hand.linear());
  return (a.T_camera_hand.translation() - b.T_camera_hand.translation()).norm() < kRestPosition &&
         turn < kRestAngle && posture_distance(a.posture, b.posture) < kRestAngle;
}

bool has_posture(const TrackResult& r) { return r.status == TrackStatus::tracked && r.has.posture; }

bool has_pose(const TrackResult& r) { return r.status == TrackStatus::tracked && r.has.pose; }

/// Sum over tracked frames of the distance between estimated posture and the truth `delay` frames earlier.
double delayed_distance(std::span<const TrackResult> estimates, std::span<const HandFrame> truth, int delay) {
  double sum = 0;
  for (size_t i = kMaxLatency; i < truth.size(); ++i) {
    if (!has_posture(estimates[i])) continue;  // a lost frame repeats an older posture
    sum += posture_distance(estimates[i].posture, truth[i - delay].posture);
  }
  return sum;
}

std::optional<double> latency_frames(std::span<const TrackResult> estimates, std::span<const HandFrame> truth) {
  if (truth.size() < 3 * kMaxLatency ||
      std::ranges::count_if(estimates.subspan(kMaxLatency), has_posture) < kMaxLatency)
    return {};
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

std::vector<reports::FrameErrors> measure(const Run& run, const HandModel& tracker_hand,
                                          const render::Subject& subject) {
  std::vector<reports::FrameErrors> errors;
  const std::span<const HandFrame> frames = frames_of(run.spec);
  for (size_t f = 0; f < frames.size(); ++f) {
    const reports::FrameTruth truth = {
        frames[f].posture,          frames[f].T_camera_hand, subject.joints(frames[f].posture),
        run.seen[f].visible_pixels, run.seen[f].trackable,   run.seen[f].visible_percent};
    const int number = run.spec.frames.first + static_cast<int>(f);
    errors.push_back(reports::measure_frame(number, run.answers[f], truth, tracker_hand));
  }
  return errors;
}

std::vector<MeasuredRun> measure(Workbench& workbench, std::vector<Run> runs) {
  std::vector<MeasuredRun> measured(runs.size());
  in_parallel(workbench.config().threads, runs.size(), [&](size_t r) {
    const render::Subject subject = workbench.subject(runs[r].spec.subject);
    std::vector<reports::FrameErrors> errors = measure(runs[r], *workbench.model(), subject);
    measured[r] = {std::move(runs[r]), std::move(errors)};
  });
  return measured;
}

reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates,
                                          std::span<const HandFrame> truth) {
  check(estimates.size() == truth.size(), "an estimate for each frame of the truth");
  reports::SequenceMetrics metrics;
  double position = 0, rotation = 0;
  int steps = 0;
  for (size_t i = 1; i < truth.size(); ++i) {
    const TrackResult &a = estimates[i - 1], &b = estimates[i];
    if (!has_pose(a) || !has_pose(b) || !at_rest(truth[i - 1], truth[i])) continue;
    const Eigen::Isometry3d error_a = a.T_camera_hand * truth[i - 1].T_camera_hand.inverse();
    const Eigen::Isometry3d error_b = b.T_camera_hand * truth[i].T_camera_hand.inverse();
    const Eigen::Vector3d move = (b.T_camera_hand.translation() - truth[i].T_camera_hand.translation()) -
                                 (a.T_camera_hand.translation() - truth[i - 1].T_camera_hand.translation());
    position += move.squaredNorm();
    rotation += std::pow(degrees_from_radians(angle_between(error_a.linear(), error_b.linear())), 2);
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
