#include "core/tracker/tracker.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/kinect/disparity.h"
#include "core/pose/interpolate.h"

namespace glovebench {
namespace {

int border_pixels(const LabelImage& labels) {
  int count = 0;
  const int w = labels.width(), h = labels.height();
  for (int u = 0; u < w; ++u) count += (labels(u, 0) != 0) + (labels(u, h - 1) != 0);
  for (int v = 1; v + 1 < h; ++v) count += (labels(0, v) != 0) + (labels(w - 1, v) != 0);
  return count;
}

}  // namespace

TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config) {
  if (static_cast<int>(cloud.points.size()) < config.min_pixels) {
    return cloud.labeled_outside >= config.min_pixels ? TrackStatus::outside_volume : TrackStatus::no_hand;
  }
  // A third of the glove is missing: what is left would be matched as if it were all.
  if (2 * cloud.labeled_cut_off > static_cast<int>(cloud.points.size())) return TrackStatus::outside_volume;
  const double size_px = std::sqrt(static_cast<double>(cloud.points.size()));
  const double most = std::min<double>(config.max_border_pixels, config.max_border_share * size_px);
  if (border_pixels(cloud.labels) > most) return TrackStatus::cut_by_border;
  const std::vector<int> sizes = component_sizes(cloud, config.component_depth_step);
  if (sizes.size() > 1 && sizes[1] > config.second_hand_share * sizes[0]) return TrackStatus::several_hands;
  return TrackStatus::tracked;
}

namespace {

TrackStatus status_of(AlignmentStatus status) {
  switch (status) {
    case AlignmentStatus::converged:
    case AlignmentStatus::not_converged:
      return TrackStatus::tracked;
    case AlignmentStatus::too_few_points:
      return TrackStatus::too_few_points;
    case AlignmentStatus::degenerate_cloud:
      return TrackStatus::degenerate_cloud;
    case AlignmentStatus::no_shared_color:
      return TrackStatus::no_shared_color;
  }
  return TrackStatus::too_few_points;
}

}  // namespace

std::string_view to_string(TrackStatus status) {
  static constexpr std::array<std::string_view, kTrackStatusCount> names = {
      "tracked",        "no_hand",          "outside_volume",  "cut_by_border", "several_hands",
      "too_few_points", "degenerate_cloud", "no_shared_color", "poor_match",    "poor_alignment"};
  return names[static_cast<size_t>(status)];
}

Tracker::Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
                 std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table)
    : config_(std::move(config)),
      calibration_(std::move(calibration)),
      model_(std::move(model)),
      database_(std::move(database)),
      table_(std::move(table)),
      smoother_(config_.smoothing) {
  const std::vector<std::string> problems = config_.problems();
  if (!problems.empty()) throw Error(fmt::format("tracker configuration: {}", fmt::join(problems, "; ")));
  if (model_->side() != database_->side()) {
    const auto name = [](Side side) { return side == Side::right ? "a right hand" : "a left hand"; };
    throw Error("database " + database_->posture_set().name, "side", name(database_->side()), name(model_->side()));
  }
  for (const CascadeStage& stage : config_.lookup.cascade) {
    if (database_->has_size(stage.size)) continue;
    throw Error("database " + database_->posture_set().name, "tiny images", fmt::format("no {} px", stage.size),
                "the sizes of the cascade " + to_string(config_.lookup.cascade));
  }
  if (table_->space() != config_.segmentation.color_space) {
    throw Error("color table", "color space", std::string(to_string(table_->space())),
                fmt::format("{} (segmentation.color_space)", to_string(config_.segmentation.color_space)));
  }
}

TrackResult Tracker::track(const DeviceFrame& frame, const StageObserver& observe, FrameTrace* trace) {
  const StageObserver silent = [](std::string_view) {};
  TrackResult result = estimate(frame, observe ? observe : silent, trace);
  if (observe) observe("smooth");
  result = smoother_.smooth(std::move(result));
  if (observe) observe("");
  return result;
}

TrackResult Tracker::estimate(const DeviceFrame& frame, const StageObserver& observe, FrameTrace* trace) const {
  TrackResult result;
  result.timestamp_us = frame.depth_timestamp_us;

  observe("register");
  const DepthImage depth = depth_from_disparity(frame.raw_disparity);
  const RegisteredImage mapped = register_color(depth, frame.color, calibration_, config_.registration);

  observe("segment");
  LabelImage labels = segment(mapped, *table_);
  if (config_.segmentation.majority_filter) labels = majority_filter(labels);

  observe("cloud");
  LabeledCloud cloud = build_cloud(depth, labels, calibration_.ir, config_.volume);
  if (config_.segmentation.largest_component) {
    cloud = largest_component(cloud, config_.detection.component_depth_step);
  }
  result.cloud_points = static_cast<int>(cloud.points.size());
  result.status = detect(cloud, config_.detection);
  if (trace != nullptr) *trace = {depth, mapped, labels, cloud, {}};
  if (result.status != TrackStatus::tracked) return result;

  observe("tiny_images");
  const Square square = bounding_square(cloud.labels);
  const TinyImages query = make_tiny_images(cloud.labels, square, config_.lookup.cascade);
  if (trace != nullptr) trace->tiny = query.images.back();

  observe("look_up");
  result.matches = look_up(*database_, query, config_.lookup.cascade);
  if (result.matches.empty()) return result.status = TrackStatus::no_hand, result;
  if (result.matches[0].error > config_.lookup.max_matching_error * config_.lookup.cascade.back().size) {
    return result.status = TrackStatus::poor_match, result;
  }
  const CoarseEstimate coarse = interpolate(*database_, result.matches, square_ray(square, calibration_.ir),
                                            config_.lookup.interpolation_epsilon);
  result.ambiguous = coarse.ambiguous;
  result.posture_unfiltered = coarse.posture;

  observe("align");
  const PosedHand hand = model_->pose(coarse.posture);
  result.T_camera_hand_coarse = coarse_pose(*model_, hand, coarse.R_camera_hand, cloud.points);
  const Alignment alignment = align(*model_, hand, cloud.points, result.T_camera_hand_coarse, config_.icp);
  result.T_camera_hand_unfiltered = alignment.T_camera_hand;
  result.converged = alignment.status == AlignmentStatus::converged;
  result.icp_points = alignment.points;
  result.icp_iterations = alignment.iterations;
  result.icp_residual = alignment.residual;
  result.status = status_of(alignment.status);
  if (result.status == TrackStatus::tracked && alignment.residual > config_.max_residual) {
    result.status = TrackStatus::poor_alignment;
  }
  return result;
}

}  // namespace glovebench
