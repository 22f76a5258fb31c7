#include "eval/regression/changed_frames.h"

#include <fmt/format.h>

#include <map>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/camera/registration.h"
#include "core/kinect/disparity.h"
#include "eval/program.h"
#include "eval/run.h"
#include "render/label_renderer.h"
#include "render/pictures.h"
#include "reports/estimates.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

using reports::ChangedFrame;
using reports::Estimate;

constexpr Rgb kTruth = {255, 255, 255}, kBaseline = {90, 170, 255}, kCandidate = {255, 150, 40};
constexpr int kChangedFrameMargin = 20;  // px around the hand
constexpr int kPanelSize = 300;          // px

/// A run's estimates, read on demand.
class StoredEstimates {
 public:
  explicit StoredEstimates(const FileSet& set) : set_(set) {}

  /// Empty if the folder has no estimates of the experiment, or the frame was lost.
  std::optional<Estimate> find(const reports::ExperimentKey& key, uint64_t seed, int frame) {
    const std::string name = reports::estimates_file(key);
    if (!files_.contains(name)) {
      files_[name] = set_.has(name) ? reports::parse_estimates(set_.read(name, kLargestResults), set_.path(name))
                                    : std::vector<Estimate>{};
    }
    for (const Estimate& estimate : files_[name]) {
      if (estimate.seed != seed || estimate.frame != frame) continue;
      if (estimate.status == TrackStatus::tracked) return estimate;
    }
    return std::nullopt;
  }

 private:
  const FileSet& set_;
  std::map<std::string, std::vector<Estimate>> files_;
};

class Scene {
 public:
  Scene(Workbench& workbench, const ChangedFrame& change, std::shared_ptr<const trajectories::Trajectory> truth)
      : workbench_(workbench), camera_(workbench.calibration().ir) {
    RunSpec spec{std::move(truth), {change.frame, 1}, change.key.subject, change.key.noise, change.candidate_seed};
    spec.appearance = change.key.appearance;
    render::SyntheticKinect kinect = make_kinect(workbench, spec);
    const DeviceFrame device = kinect.next_frame().value();
    picture_ =
        register_color(depth_from_disparity(device.raw_disparity), device.color, workbench.calibration(), {}).color;
    true_hand_ = silhouette(kinect.truth().label);
  }

  ColorImage picture() const { return cropped(picture_); }
  ColorImage with_outlines(const std::optional<Estimate>& estimate, const Rgb& color) {
    ColorImage image = render::overlay_outline(picture_, true_hand_, kTruth);
    if (estimate) {
      const HandModel& model = *workbench_.model();
      const LabelImage hand =
          renderer_.render_labels(model, model.pose(estimate->posture), camera_, estimate->T_camera_hand);
      image = render::overlay_outline(image, silhouette(hand), color);
    }
    return cropped(image);
  }

 private:
  static LabelImage silhouette(LabelImage labels) {
    for (uint8_t& label : labels) label = label > 0;
    return labels;
  }
  ColorImage cropped(const ColorImage& image) const {
    return render::crop_to_labels(image, true_hand_, kChangedFrameMargin);
  }

  Workbench& workbench_;
  PinholeCamera camera_;
  render::LabelRenderer renderer_;
  ColorImage picture_;
  LabelImage true_hand_;
};

std::string error_text(const std::optional<double>& vertex_error_mm) {
  return vertex_error_mm ? reports::fixed(vertex_error_mm, 1) + " mm" : "lost";
}

/// Adds one run's panel, unless the run tracked the frame but kept no estimates.
void add_panel(std::vector<render::Panel>& panels, Scene& scene, const std::string& run, const Rgb& color,
               const std::optional<double>& vertex_error_mm, const std::optional<Estimate>& estimate) {
  if (vertex_error_mm && !estimate) return;
  panels.push_back({run + ": " + error_text(vertex_error_mm), scene.with_outlines(estimate, color)});
}

reports::Picture draw(Scene& scene, const ChangedFrame& change, const std::optional<Estimate>& baseline,
                      const std::optional<Estimate>& candidate) {
  std::vector<render::Panel> panels = {{"what the depth camera's pixels saw", scene.picture()}};
  add_panel(panels, scene, "baseline", kBaseline, change.baseline_vertex_error_mm, baseline);
  add_panel(panels, scene, "candidate", kCandidate, change.candidate_vertex_error_mm, candidate);
  return {
      fmt::format("{}, frame {}, seed {}: mean vertex error {} before, {} now. Outlines: the true hand white, the "
                  "baseline's blue, the candidate's orange.",
                  to_string(change.key), change.frame, change.candidate_seed,
                  error_text(change.baseline_vertex_error_mm), error_text(change.candidate_vertex_error_mm)),
      encode_png(render::montage(panels, static_cast<int>(panels.size()), kPanelSize, kPanelSize))};
}

/// Used for its hands only; no database is needed.
std::unique_ptr<Workbench> make_workbench(Side side) {
  WorkbenchConfig config;
  config.side = side;
  return std::make_unique<Workbench>(config);
}

}  // namespace

std::vector<reports::Picture> picture_changes(const reports::Comparison& comparison,
                                              const reports::RunResult& candidate, const FileSet& baseline_files,
                                              const FileSet& candidate_files) {
  if (candidate.configuration.contains("calibration") || candidate.configuration.contains("hand")) return {};
  const auto& truths = candidate.inputs.truths;
  StoredEstimates before(baseline_files), after(candidate_files);
  std::map<Side, std::unique_ptr<Workbench>> workbenches;
  std::vector<reports::Picture> pictures;
  for (const ChangedFrame& change : comparison.worst) {
    const std::shared_ptr<const trajectories::Trajectory> truth = find_truth(change.key);
    const auto hash = truths.find(truth_name(change.key));
    if (!truth || hash == truths.end() || hash->second != trajectories::hash(*truth)) continue;
    std::unique_ptr<Workbench>& workbench = workbenches[truth->side];
    if (!workbench) workbench = make_workbench(truth->side);
    Scene scene(*workbench, change, truth);
    pictures.push_back(draw(scene, change, before.find(change.key, change.baseline_seed, change.frame),
                            after.find(change.key, change.candidate_seed, change.frame)));
  }
  return pictures;
}

}  // namespace glovebench::eval
