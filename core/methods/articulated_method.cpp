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

// A hand that the border cuts is followed within these limits.
constexpr double kLeastPart = 0.25;      ///< share of its vertices within the image: with less its pose is a guess
constexpr double kPartResidual = 0.004;  ///< m: if the points lie farther from it, they are something else

/// Share of the hand's vertices within the image.
double share_in_image(const HandModel& model, const ArticulatedPose& pose, const PinholeCamera& camera) {
  const PosedHand hand = model.pose(pose.posture);
  const auto is_inside = [&](const Eigen::Vector3f& vertex) {
    const Eigen::Vector3d p = pose.T_camera_hand * vertex.cast<double>();
    if (!(p.z() > 0)) return false;
    const Eigen::Vector2d uv = camera.project(p);
    return uv.x() >= 0 && uv.y() >= 0 && uv.x() <= camera.width - 1 && uv.y() <= camera.height - 1;
  };
  return static_cast<double>(std::ranges::count_if(hand.vertices, is_inside)) /
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
  /// The frame before; for a whole hand also the mean of the matches and the nearest one.
  RecycledVector<ArticulatedPose> starts(const TrackResult& result, const TrackResult* previous,
                                         const HandLookUp& found, const LabeledCloud& cloud) const;

  MethodInputs in_;
  ArticulatedFit fit_;
  HandView view_;
};

RecycledVector<ArticulatedPose> Articulated::starts(const TrackResult& result, const TrackResult* previous,
                                                    const HandLookUp& found, const LabeledCloud& cloud) const {
  RecycledVector<ArticulatedPose> all;
  if (previous != nullptr) all.push_back({previous->posture_unfiltered, previous->T_camera_hand_unfiltered});
  if (result.matches.empty()) return all;
  all.push_back({found.coarse.posture, result.T_camera_hand_coarse});
  if (result.matches.size() == 1) return all;
  const CoarseEstimate nearest = interpolate(*in_.database, std::span(result.matches).first(1), found.ray,
                                             in_.config.lookup.interpolation_epsilon);
  const PosedHand hand = in_.model->pose(nearest.posture);
  all.push_back({nearest.posture, coarse_pose(*in_.model, hand, nearest.R_camera_hand, cloud.points)});
  return all;
}

TrackResult Articulated::estimate(const DeviceFrame& frame, const TrackResult* previous,
                                  const StageObserver& observe) {
  TrackResult result;
  const Sighting seen = see_in_reach(frame, in_.calibration, *in_.table, in_.config, observe);
  result.cloud_points = static_cast<int>(seen.cloud.points.size());
  result.status = seen.status;
  const bool is_part = previous != nullptr && seen.status == TrackStatus::cut_by_border;
  if (result.status != TrackStatus::tracked && !is_part) return result;

  HandLookUp found;
  if (is_part) {
    result.T_camera_hand_coarse = previous->T_camera_hand_unfiltered;
  } else {
    found = look_up_hand(seen.cloud.labels, in_.calibration.ir, *in_.database, in_.config.lookup, observe);
    result.matches = std::move(found.matches);
    result.status = found.status;
    if (result.status != TrackStatus::tracked) return result;
    const CoarseEstimate& mean = found.coarse;
    result.ambiguous = mean.ambiguous;
    result.T_camera_hand_coarse =
        coarse_pose(*in_.model, in_.model->pose(mean.posture), mean.R_camera_hand, seen.cloud.points);
  }

  observe(Stage::mask);
  view_.assign(seen, frame, in_.config.volume);

  observe(Stage::fit);
  const ArticulatedEstimate fitted =
      fit_({view_.points, view_.mask, in_.calibration.ir}, starts(result, previous, found, seen.cloud),
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
  if (is_part && (!result.converged || fitted.residual > kPartResidual ||
                  share_in_image(*in_.model, fitted.pose, in_.calibration.ir) < kLeastPart))
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
