#include "core/tracker/tracker.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/pose/interpolate.h"

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

bool is_poor_match(std::span<const Match> matches, const LookupConfig& config) {
  return matches.front().error > config.max_matching_error * config.cascade.back().size;
}

Tracker::Tracker(TrackerConfig config, RgbdCalibration calibration, std::shared_ptr<const HandModel> model,
                 std::shared_ptr<const Database> database, std::shared_ptr<const ColorTable> table)
    : config_(std::move(config)),
      calibration_(std::move(calibration)),
      model_(std::move(model)),
      database_(std::move(database)),
      table_(std::move(table)),
      smoother_(config_.smoothing) {
  check_inputs(config_, *model_, *database_, *table_);
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

  const Sighting seen =
      see(frame, calibration_, *table_, config_, observe, trace == nullptr ? Extent::reach : Extent::everything);
  const LabeledCloud& cloud = seen.cloud;
  result.cloud_points = static_cast<int>(cloud.points.size());
  result.status = seen.status;
  if (trace != nullptr) *trace = {seen, {}};
  if (result.status != TrackStatus::tracked) return result;

  observe("tiny_images");
  const Square square = bounding_square(cloud.labels);
  const TinyImages query = make_tiny_images(cloud.labels, square, config_.lookup.cascade);
  if (trace != nullptr) trace->tiny = query.images.back();

  observe("look_up");
  result.matches = look_up(*database_, query, config_.lookup.cascade, config_.lookup.implementation);
  if (result.matches.empty()) return result.status = TrackStatus::no_hand, result;
  if (is_poor_match(result.matches, config_.lookup)) return result.status = TrackStatus::poor_match, result;
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
