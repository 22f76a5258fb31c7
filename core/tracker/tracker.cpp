#include "core/tracker/tracker.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/tracker/smoothing.h"

namespace glovebench {

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

void check_inputs(const TrackerConfig& config, const HandModel& model, const Database& database,
                  const ColorTable& table) {
  const std::vector<std::string> problems = config.problems();
  if (!problems.empty()) throw Error(fmt::format("tracker configuration: {}", fmt::join(problems, "; ")));
  if (model.side() != database.side()) {
    const auto name = [](Side side) { return side == Side::right ? "a right hand" : "a left hand"; };
    throw Error("database " + database.posture_set().name, "side", name(database.side()), name(model.side()));
  }
  for (const CascadeStage& stage : config.lookup.cascade) {
    if (database.has_size(stage.size)) continue;
    throw Error("database " + database.posture_set().name, "tiny images", fmt::format("no {} px", stage.size),
                "the sizes of the cascade " + to_string(config.lookup.cascade));
  }
  if (table.space() != config.segmentation.color_space) {
    throw Error("color table", "color space", std::string(to_string(table.space())),
                fmt::format("{} (segmentation.color_space)", to_string(config.segmentation.color_space)));
  }
}

Tracker::Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
                 std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table)
    : config_(std::move(config)),
      calibration_(std::move(calibration)),
      model_(std::move(model)),
      database_(std::move(database)),
      table_(std::move(table)) {
  check_inputs(config_, *model_, *database_, *table_);
}

TrackResult Tracker::track(const DeviceFrame& frame, std::span<const TrackResult> previous,
                           const StageObserver& observe) const {
  TrackResult result = estimate(frame, observe);
  observe(Stage::smoothing);
  return smoothed(std::move(result), previous, config_.smoothing);
}

FrameTrace inspect(const DeviceFrame& frame, const RgbdCalibration& calibration, const ColorTable& table,
                   const TrackerConfig& config) {
  FrameTrace trace{see(frame, calibration, table, config), {}};
  if (trace.status == TrackStatus::tracked) {
    const LabelImage& labels = trace.cloud.labels;
    trace.tiny = make_tiny_image(labels, bounding_square(labels), config.lookup.cascade.back().size);
  }
  return trace;
}

TrackResult Tracker::estimate(const DeviceFrame& frame, const StageObserver& observe) const {
  TrackResult result;
  result.timestamp_us = frame.depth_timestamp_us;

  const Sighting seen = see_in_reach(frame, calibration_, *table_, config_, observe);
  const LabeledCloud& cloud = seen.cloud;
  result.cloud_points = static_cast<int>(cloud.points.size());
  result.status = seen.status;
  if (result.status != TrackStatus::tracked) return result;

  HandLookUp found = look_up_hand(cloud.labels, calibration_.ir, *database_, config_.lookup, observe);
  result.matches = std::move(found.matches);
  result.status = found.status;
  if (result.status != TrackStatus::tracked) return result;
  const CoarseEstimate& coarse = found.coarse;
  result.ambiguous = coarse.ambiguous;
  result.posture_unfiltered = coarse.posture;

  observe(Stage::alignment);
  const PosedHand hand = model_->pose(coarse.posture);
  result.T_camera_hand_coarse =
      coarse_pose(*model_, hand, coarse.R_camera_hand, cloud.points, config_.icp.center_visible_surface);
  const Alignment alignment = align(*model_, hand, cloud.points, result.T_camera_hand_coarse, config_.icp);
  result.T_camera_hand_unfiltered = alignment.T_camera_hand;
  result.converged = alignment.status == AlignmentStatus::converged;
  result.icp_points = alignment.points;
  result.icp_iterations = alignment.iterations;
  result.icp_residual = alignment.residual;
  result.status = status_of(alignment.status);
  if (result.status == TrackStatus::tracked && alignment.residual > config_.max_residual)
    result.status = TrackStatus::poor_alignment;
  return result;
}

HandLookUp look_up_hand(const LabelImage& labels, const PinholeCamera& camera, const Database& database,
                        const LookupConfig& config, const StageObserver& observe) {
  HandLookUp found;
  observe(Stage::tiny_images);
  found.square = bounding_square(labels);
  const TinyImages query = make_tiny_images(labels, found.square, config.cascade);

  observe(Stage::look_up);
  found.matches = look_up(database, query, config.cascade, config.implementation);
  if (found.matches.empty()) return found;
  if (found.matches.front().error > config.max_matching_error * config.cascade.back().size) {
    found.status = TrackStatus::poor_match;
    return found;
  }
  found.status = TrackStatus::tracked;
  if (config.turn_to_ray) found.ray = square_ray(found.square, camera);
  found.coarse = interpolate(database, found.matches, found.ray, config.interpolation_epsilon);
  return found;
}

}  // namespace glovebench
