#include "trajectories/capture/fit_hand.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/math.h"
#include "trajectories/capture/calibrate_hand.h"
#include "trajectories/capture/capture_hand.h"
#include "trajectories/capture/fit_frame.h"
#include "trajectories/capture/marker_sequence.h"
#include "trajectories/generation/low_dispersion.h"

namespace glovebench::trajectories {
namespace {

/// Before the hand is known its markers may be as far off as people put them.
constexpr double kFirstScale = 0.015;
constexpr double kLeastScale = 0.003;
constexpr size_t kCalibrationFrames = 40;
/// Where a hand's calibration ends: while labels are wrong, and in the end.
constexpr double kRoughGain = 1e-4, kFinalGain = 1e-6;
/// A fit of which half of the points are farther off is none.
constexpr double kLostDistance = 0.01;

using Points = std::vector<Eigen::Vector3d>;

/// The points of a capture, sorted into those of the markers and the others.
struct Cloud {
  std::vector<Points> labeled;  ///< one for each marker
  std::vector<Points> unlabeled;
};

Cloud sorted_points(const MarkerSequence& sequence) {
  Cloud cloud;
  for (const MarkerFrame& frame : sequence.frames) {
    Points& labeled = cloud.labeled.emplace_back();
    Points& unlabeled = cloud.unlabeled.emplace_back();
    for (size_t p = 0; p < sequence.names.size(); ++p)
      (is_unlabeled(sequence.names[p]) ? unlabeled : labeled).push_back(frame.points[p]);
  }
  return cloud;
}

std::vector<double> seen_distances(const CaptureHand& hand, const std::vector<Points>& points,
                                   const std::vector<HandState>& states) {
  std::vector<double> all;
  for (size_t f = 0; f < points.size(); ++f) {
    std::ranges::copy_if(point_distances(hand, points[f], states[f]), std::back_inserter(all),
                         [](double d) { return std::isfinite(d); });
  }
  return all;
}

/// How far off an ordinary point is, and so what is not ordinary.
double robust_scale(const CaptureHand& hand, const std::vector<Points>& points,
                    const std::vector<HandState>& states) {
  const double median = quantile_of(seen_distances(hand, points, states), 0.5).value_or(0);
  return std::clamp(2 * median, kLeastScale, kFirstScale);
}

/// The hand over the frames whose postures differ most.
Calibration calibrate(const CaptureHand& nominal, const std::vector<Points>& points,
                      const std::vector<HandState>& states, double scale, double smallest_gain) {
  std::vector<Posture> pool;
  for (const HandState& state : states) pool.push_back(state.posture);
  std::vector<size_t> chosen =
      low_dispersion_sample(pool, {pool.front()}, std::min(pool.size(), kCalibrationFrames));
  std::ranges::sort(chosen);
  std::vector<Points> chosen_points;
  std::vector<HandState> chosen_states;
  for (const size_t f : chosen) {
    chosen_points.push_back(points[f]);
    chosen_states.push_back(states[f]);
  }
  return calibrate_hand(nominal, chosen_points, chosen_states, scale, smallest_gain);
}

/// Every frame again, from where it was and from where its neighbors were: an outlier may have pulled one of them
/// away.
std::vector<HandState> refit(const CaptureHand& hand, const std::vector<Points>& points,
                             const std::vector<HandState>& states, double scale) {
  const FrameFitOptions options{.robust_scale = scale};
  std::vector<HandState> result;
  for (size_t f = 0; f < states.size(); ++f) {
    FrameFit best = fit_frame(hand, points[f], states[f], options);
    HandState neighbor = states[f];
    if (f > 0) neighbor.posture = result[f - 1].posture;
    const FrameFit other = fit_frame(hand, points[f], neighbor, options);
    result.push_back(other.cost < best.cost ? other.state : best.state);
  }
  return result;
}

/// `labeled`: as the capture names them, those that were given to no marker too.
bool is_lost(const std::vector<double>& distances, const Points& labeled) {
  const auto near = std::ranges::count_if(distances, [](double d) { return d < kLostDistance; });
  return 2 * near <= std::ranges::count_if(labeled, is_seen);
}

/// A pose may be bridged between two frames that are near in time.
void leave_out_long_gaps(HandFit& fit) {
  for (size_t begin = 0; begin < fit.frames.size(); ++begin) {
    if (!fit.frames[begin].bridged_pose) continue;
    size_t end = begin;
    while (end < fit.frames.size() && fit.frames[end].bridged_pose) ++end;
    const bool is_between = begin > 0 && end < fit.frames.size();
    const bool is_long =
        !is_between || fit.frames[end].timestamp_us - fit.frames[begin - 1].timestamp_us > kLongestPoseGapUs;
    for (size_t f = begin; f < end; ++f) fit.frames[f].left_out = is_long;
    begin = end;
  }
}

void report_frames(const Cloud& cloud, const std::vector<Points>& points, const std::vector<HandState>& states,
                   double scale, HandFit& fit) {
  std::vector<Observability> shown;
  std::vector<double> times_s;
  for (size_t f = 0; f < states.size(); ++f) {
    FittedFrame& frame = fit.frames[f];
    const std::vector<double> distances = point_distances(fit.hand, points[f], states[f]);
    std::ranges::copy_if(distances, std::back_inserter(frame.residuals), [](double d) { return std::isfinite(d); });
    frame.points = static_cast<int>(frame.residuals.size());
    fit.missing_points += static_cast<int>(std::ranges::count_if(cloud.labeled[f], std::not_fn(is_seen)));
    shown.push_back(observability(fit.hand, points[f], states[f], scale));
    shown.back().pose = shown.back().pose && !is_lost(distances, cloud.labeled[f]);
    times_s.push_back(static_cast<double>(frame.timestamp_us) / 1e6);
  }
  const Bridged bridged = bridge_gaps(states, shown, times_s);
  for (size_t f = 0; f < states.size(); ++f) {
    fit.frames[f].state = bridged.states[f];
    fit.frames[f].bridged_angles = bridged.angles[f];
    fit.frames[f].bridged_pose = bridged.poses[f];
  }
  leave_out_long_gaps(fit);
  fit.never_shown = bridged.never_shown;
  fit.angle_gaps = bridged.angle_gaps;
}

}  // namespace

HandFit fit_hand(const MarkerSequence& sequence, const std::vector<PlacedMarker>& markers, const Skeleton& skeleton,
                 const std::string& where) {
  const Cloud cloud = sorted_points(sequence);
  HandFit fit;
  fit.scale = hand_scale({skeleton, markers}, cloud.labeled, where);
  const CaptureHand nominal = scaled({skeleton, markers}, fit.scale);
  for (const MarkerFrame& frame : sequence.frames) fit.frames.emplace_back().timestamp_us = frame.timestamp_us;

  std::vector<HandState> states = start_states(nominal, cloud.labeled, kFirstScale, where);
  fit.hand = calibrate(nominal, cloud.labeled, states, kFirstScale, kRoughGain).hand;
  double scale = robust_scale(fit.hand, cloud.labeled, states);
  states = refit(fit.hand, cloud.labeled, states, scale);
  fit.hand = calibrate(nominal, cloud.labeled, states, scale, kRoughGain).hand;
  states = refit(fit.hand, cloud.labeled, states, scale);

  std::vector<Points> points;
  for (size_t f = 0; f < states.size(); ++f) {
    Relabeling sorted = relabel(predict_points(fit.hand, states[f]), cloud.labeled[f], cloud.unlabeled[f]);
    fit.frames[f].labels_corrected = sorted.corrected;
    points.push_back(std::move(sorted.points));
  }
  scale = robust_scale(fit.hand, points, states);
  fit.hand = calibrate(nominal, points, states, scale, kFinalGain).hand;
  states = refit(fit.hand, points, states, scale);
  report_frames(cloud, points, states, scale, fit);
  if (std::ranges::all_of(fit.frames, &FittedFrame::left_out))
    throw Error(where, "points", "no frame that fits a hand", "points of a hand whose names say where they sit");
  return fit;
}

}  // namespace glovebench::trajectories
