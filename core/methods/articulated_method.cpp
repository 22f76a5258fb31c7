// Not the paper's: what its outlook names. The look-up's postures are only where the fit begins; then pose and
// posture follow the points and the outline of the hand.

#include <algorithm>

#include "core/methods/method.h"
#include "core/pose/articulated_fit.h"
#include "core/tracker/sighting.h"
#include "core/tracker/smoothing.h"
#include "core/tracker/tracker.h"

namespace glovebench {
namespace {

constexpr double kPartResidual = 0.004;  ///< m: a part whose points lie farther from the hand is in another pose
constexpr double kLeastPart = 0.25;      ///< share of the vertices: of a smaller part the posture is a guess

/// Share of the hand's vertices within the image and the volume.
double share_in_view(const HandModel& model, const ArticulatedPose& pose, const PinholeCamera& camera,
                     const WorkingVolume& volume) {
  const PosedHand hand = model.pose(pose.posture);
  const auto is_in_view = [&](const Eigen::Vector3f& vertex) {
    const Eigen::Vector3d p = pose.T_camera_hand * vertex.cast<double>();
    if (p.z() < volume.z_min || p.z() > volume.z_max) return false;
    const Eigen::Vector2d uv = camera.project(p);
    return uv.x() >= 0 && uv.y() >= 0 && uv.x() <= camera.width - 1 && uv.y() <= camera.height - 1;
  };
  return static_cast<double>(std::ranges::count_if(hand.vertices, is_in_view)) /
         static_cast<double>(hand.vertices.size());
}

class Articulated : public Method {
 public:
  explicit Articulated(const MethodInputs& inputs)
      : in_(inputs), fit_(inputs.model, {}, inputs.config.icp.implementation) {
    check_inputs(in_.config, *in_.model, *in_.database, *in_.table);
  }

  TrackResult track(const DeviceFrame& frame, std::span<const TrackResult> previous,
                    const StageObserver& observe) override {
    const SmoothingConfig unfiltered = {0, 0, in_.config.smoothing.forget_after};
    TrackResult result = estimate(frame, last_tracked(previous, unfiltered.forget_after), observe);
    result.timestamp_us = frame.depth_timestamp_us;
    return smoothed(std::move(result), previous, unfiltered);
  }

 private:
  TrackResult estimate(const DeviceFrame& frame, const TrackResult* previous, const StageObserver& observe);
  /// The look-up's mean and matches. Writes matches, status, `ambiguous`. Empty without a match.
  RecycledVector<ArticulatedPose> look_up(const LabeledCloud& cloud, const StageObserver& observe,
                                          TrackResult& result) const;

  MethodInputs in_;
  ArticulatedFit fit_;
  HandView view_;
};

RecycledVector<ArticulatedPose> Articulated::look_up(const LabeledCloud& cloud, const StageObserver& observe,
                                                     TrackResult& result) const {
  HandLookUp found = look_up_hand(cloud.labels, in_.calibration.ir, *in_.database, in_.config.lookup, observe);
  result.matches = std::move(found.matches);
  result.status = found.status;
  if (result.status != TrackStatus::tracked) return {};
  result.ambiguous = found.coarse.ambiguous;
  const auto placed = [&](const CoarseEstimate& one) {
    return ArticulatedPose{one.posture,
                           coarse_pose(*in_.model, in_.model->pose(one.posture), one.R_camera_hand, cloud.points)};
  };
  RecycledVector<ArticulatedPose> starts = {placed(found.coarse)};
  for (const Match& match : result.matches) {
    starts.push_back(placed(
        interpolate(*in_.database, std::span(&match, 1), found.ray, in_.config.lookup.interpolation_epsilon)));
  }
  return starts;
}

TrackResult Articulated::estimate(const DeviceFrame& frame, const TrackResult* previous,
                                  const StageObserver& observe) {
  TrackResult result;
  const Sighting seen = see_in_reach(frame, in_.calibration, *in_.table, in_.config, observe);
  result.cloud_points = static_cast<int>(seen.cloud.points.size());
  result.status = seen.status;

  RecycledVector<ArticulatedPose> starts;
  const bool is_part = previous != nullptr && is_part_of_hand(seen, in_.config.detection);
  if (seen.status == TrackStatus::tracked) starts = look_up(seen.cloud, observe, result);
  if (starts.empty() && !is_part) return result;
  if (previous != nullptr) starts.push_back({previous->posture_unfiltered, previous->T_camera_hand_unfiltered});
  result.T_camera_hand_coarse = starts.front().T_camera_hand;

  observe(Stage::mask);
  view_.assign(seen, frame);

  observe(Stage::fit);
  const ArticulatedEstimate fitted = fit_({view_.points, view_.mask, in_.calibration.ir}, starts,
                                          previous == nullptr ? nullptr : &previous->posture_unfiltered);
  result.posture_unfiltered = fitted.pose.posture;
  result.T_camera_hand_unfiltered = fitted.pose.T_camera_hand;
  result.converged = fitted.status == AlignmentStatus::converged;
  result.icp_points = fitted.points;
  result.icp_iterations = fitted.steps;
  result.icp_residual = fitted.residual;
  if (!is_part) result.misfit = fitted.misfit;
  if (result.converged) result.certainty = {fitted.deviation, fitted.hidden};
  result.status = status_of(fitted.status);
  if (result.converged && fitted.residual > in_.config.max_residual) result.status = TrackStatus::poor_alignment;
  if (is_part && (fitted.residual > kPartResidual ||
                  share_in_view(*in_.model, fitted.pose, in_.calibration.ir, in_.config.volume) < kLeastPart))
    result.status = seen.status;
  return result;
}

std::unique_ptr<Method> make_articulated(const MethodInputs& inputs) {
  return std::make_unique<Articulated>(inputs);
}

}  // namespace

MethodEntry articulated_method() {
  return {"articulated",
          "pose and 22 angles refined against points and outline, from the look-up's postures and the frame before",
          make_articulated};
}

}  // namespace glovebench
