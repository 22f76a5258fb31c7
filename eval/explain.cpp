#include "eval/explain.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "render/label_renderer.h"
#include "render/pictures.h"

namespace glovebench::eval {
namespace {

constexpr int kMargin = 20;  // px around the hand

struct OneFrame {
  DeviceFrame frame;
  render::RgbdImages truth;
};
OneFrame take_frame(Workbench& workbench, Replay replay, int frame) {
  replay.range = {frame, 1};
  render::SyntheticKinect kinect = make_kinect(workbench, replay);
  const std::optional<DeviceFrame> taken = kinect.next_frame();
  return {*taken, kinect.truth()};
}

/// Outline of the estimated hand over M.
ColorImage overlay(const HandModel& model, const TrackResult& result, const Eigen::Isometry3d& T_camera_hand,
                   const FrameTrace& trace, const PinholeCamera& camera) {
  render::LabelRenderer renderer;
  return render::overlay_outline(
      trace.mapped.color,
      renderer.render_labels(model, model.pose(result.posture_unfiltered), camera, T_camera_hand));
}

std::string depth_title(const TrackResult& result) {
  return fmt::format("depth, {} cloud points", result.cloud_points);
}

}  // namespace

ColorImage explain_frame(Workbench& workbench, const Replay& replay, int frame) {
  const int count = static_cast<int>(replay.truth->frames.size());
  if (frame < 0 || frame >= count) {
    throw Error(replay.truth->name, "frame", std::to_string(frame), fmt::format("0 to {}", count - 1));
  }
  const OneFrame taken = take_frame(workbench, replay, frame);
  const std::shared_ptr<const Database> database = workbench.database(replay.databases.front());
  Tracker tracker = workbench.make_tracker(replay.tracker, replay.databases.front());
  const TrackResult result = tracker.track(taken.frame);
  const FrameTrace trace = tracker.inspect(taken.frame);

  const auto cropped = [&](const ColorImage& image) {
    return render::crop_to_labels(image, taken.truth.label, kMargin);
  };
  std::vector<render::Panel> panels = {
      {fmt::format("{} frame {}: color camera", replay.truth->name, frame), taken.frame.color},
      {depth_title(result), render::picture_of_depth(trace.depth, 0.4, 1.8)},
      {"mapped image M", cropped(trace.mapped.color)},
      {"labels L in the working volume", cropped(render::picture_of_labels(trace.cloud.labels))},
      {"true labels", cropped(render::picture_of_labels(taken.truth.label))},
      {fmt::format("tiny image {0} x {0}", trace.tiny.width()), render::picture_of_labels(trace.tiny)}};
  for (const Match& match : result.matches) {
    const int posture = match.entry / kViewCount;
    panels.push_back({fmt::format("{}, view {}: E {:.2f} px", database->posture_set().posture_names[posture],
                                  Database::view(match.entry), match.error),
                      render::picture_of_labels(database->labels(trace.tiny.width(), match.entry))});
  }
  if (result.status == TrackStatus::tracked) {
    const HandModel& model = *workbench.model();
    const reports::FrameErrors errors =
        reports::measure_frame(frame, result,
                               {replay.truth->frames[frame].posture, replay.truth->frames[frame].T_camera_hand,
                                workbench.subject(replay.subject).joints(replay.truth->frames[frame].posture),
                                reports::count_patches(taken.truth.patch)},
                               model);
    const PinholeCamera& camera = workbench.calibration().ir;
    panels.push_back(
        {"coarse pose over M", cropped(overlay(model, result, result.T_camera_hand_coarse, trace, camera))});
    panels.push_back({fmt::format("after ICP-T: {} iterations, {:.1f} mm, {:.1f} deg off", result.icp_iterations,
                                  *errors.record["position_error_mm"], *errors.record["rotation_error_deg"]),
                      cropped(overlay(model, result, result.T_camera_hand, trace, camera))});
  } else {
    panels.push_back({"lost: " + std::string(to_string(result.status)), {}});
  }
  return render::montage(panels, 4, 360, 300);
}

}  // namespace glovebench::eval
