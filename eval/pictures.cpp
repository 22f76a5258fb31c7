#include "eval/pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/pose/interpolate.h"
#include "eval/program.h"
#include "eval/run_warnings.h"
#include "render/label_renderer.h"
#include "render/pictures.h"
#include "render/rgbd_renderer.h"
#include "reports/metrics/measure_frame.h"
#include "reports/page/page.h"
#include "reports/text.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::Estimate;
using reports::ExperimentKey;
using reports::FrameSheet;

constexpr int kJpegQuality = 80;

/// The plan must contain the run.
const RunSpec& find_spec(const Plan& plan, const ExperimentKey& key, uint64_t seed) {
  const auto found = std::ranges::find_if(
      plan.specs, [&](const RunSpec& spec) { return spec.seed == seed && key_of(spec) == key; });
  check(found != plan.specs.end(), "frames come from a run of the plan");
  return *found;
}

std::optional<HandFrame> hand_in_run(const std::vector<reports::ExperimentEstimates>& all, const ExperimentKey& key,
                                     uint64_t seed, int frame) {
  const auto found = std::ranges::find(all, key, &reports::ExperimentEstimates::key);
  return found == all.end() ? std::nullopt : reports::find_hand(found->estimates, seed, frame);
}

/// Estimates of the experiment's first seed.
std::vector<Estimate> first_seed(const std::vector<reports::ExperimentEstimates>& all, const ExperimentKey& key) {
  std::vector<Estimate> estimates;
  const auto found = std::ranges::find(all, key, &reports::ExperimentEstimates::key);
  if (found == all.end()) return estimates;
  for (const Estimate& estimate : found->estimates)
    if (estimate.seed == found->estimates.front().seed) estimates.push_back(estimate);
  return estimates;
}

std::vector<reports::FrameSheet> make_sheets(Workbench& workbench, const Plan& plan,
                                             const reports::RunResult& result,
                                             const std::vector<reports::ExperimentEstimates>& all_estimates) {
  const reports::PaperNumbers& paper = reports::paper_numbers();
  const reports::NoiseSetting noise = reports::headline_noise(result);
  std::vector<reports::FrameSheet> sheets;
  for (const auto& [figure, curve] : {std::pair{"figure5", &paper.figure_5}, {"figure6", &paper.figure_6}}) {
    const ExperimentKey key = {curve->trajectory, curve->database, reports::TruthKind::recorded, 1, noise};
    const std::vector<Estimate> estimates = first_seed(all_estimates, key);
    if (estimates.empty()) continue;
    const RunSpec& spec = find_spec(plan, key, estimates.front().seed);
    sheets.push_back(make_frame_sheet(workbench, figure, frames_of(spec), estimates));
  }
  return sheets;
}

std::vector<reports::Picture> picture_worst_frames(Workbench& workbench, const Plan& plan,
                                                   const reports::RunResult& result,
                                                   const std::vector<reports::ExperimentEstimates>& estimates,
                                                   const std::set<std::string>& from_files) {
  std::vector<reports::Picture> pictures;
  for (const reports::WorstFrame& worst : reports::worst_frames(result)) {
    const RunSpec& spec = find_spec(plan, worst.key, worst.seed);
    const std::optional<HandFrame> hand = hand_in_run(estimates, worst.key, worst.seed, worst.frame.frame);
    const ColorImage picture = explain_frame(workbench, spec, worst.frame, hand);
    pictures.push_back({caption(worst), encode_jpeg(picture, kJpegQuality), explain_command(worst, from_files)});
  }
  return pictures;
}

constexpr int kMargin = 20;  // px around the hand
constexpr int kCellWidth = 360, kCellHeight = 300, kPanelColumns = 4;

struct OneFrame {
  DeviceFrame frame;
  render::RgbdImages truth;
};
OneFrame take_frame(Workbench& workbench, RunSpec spec, int frame) {
  spec.frames = {frame, 1};
  render::SyntheticKinect kinect = make_kinect(workbench, spec);
  const std::optional<DeviceFrame> taken = kinect.next_frame();
  return {*taken, kinect.truth()};
}

constexpr Rgb kTrueOutline = {255, 255, 255}, kEstimatedOutline = {255, 150, 40}, kRunOutline = {90, 170, 255};

LabelImage silhouette(LabelImage labels) {
  for (uint8_t& label : labels) label = label > 0;
  return labels;
}

struct Outline {
  Posture posture;
  Eigen::Isometry3d T_camera_hand;
  Rgb color;
};
/// Outlines the true hand and others on M.
ColorImage overlay(const HandModel& model, std::span<const Outline> hands, const FrameTrace& trace,
                   const LabelImage& true_labels, const PinholeCamera& camera) {
  render::LabelRenderer renderer;
  ColorImage image = render::overlay_outline(trace.mapped.color, silhouette(true_labels), kTrueOutline);
  for (const auto& [posture, T_camera_hand, color] : hands) {
    const LabelImage labels = renderer.render_labels(model, model.pose(posture), camera, T_camera_hand);
    image = render::overlay_outline(image, silhouette(labels), color);
  }
  return image;
}

std::vector<render::TextLine> errors_alone(const reports::FrameErrors& errors) {
  const reports::FrameRecord& record = errors.record;
  std::vector<std::string> tips;
  for (const int tip : fingertip_joints()) tips.push_back(reports::fixed(errors.joint_errors_mm[tip], 0));
  return {{"Errors without earlier frames:"},
          {fmt::format("position {:.1f} mm, rotation {:.1f} deg", *record["position_error_mm"],
                       *record["rotation_error_deg"])},
          {fmt::format("posture {:.1f} deg (RMS of 22 angles)", *record["posture_rms_deg"])},
          {fmt::format("fingertips {:.1f} mm, each {}", *record["fingertip_error_mm"], fmt::join(tips, ", "))}};
}

std::vector<render::TextLine> errors_in_run(const reports::FrameRecord& record) {
  if (record.status != TrackStatus::tracked)
    return {{fmt::format("In the run: lost, {}", to_string(record.status))}};
  return {{"In the run:"},
          {fmt::format("position {} mm, rotation {} deg", reports::fixed(record["position_error_mm"], 1),
                       reports::fixed(record["rotation_error_deg"], 1))},
          {fmt::format("posture {} deg, fingertips {} mm", reports::fixed(record["posture_rms_deg"], 1),
                       reports::fixed(record["fingertip_error_mm"], 1))}};
}

/// Explains the outlines and E, and lists the errors. `alone`: empty if the frame is lost.
ColorImage legend(const std::optional<reports::FrameErrors>& alone, const reports::FrameRecord& in_run) {
  std::vector<render::TextLine> lines = {{"white: the true hand", kTrueOutline}};
  const auto append = [&](const std::vector<render::TextLine>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  if (alone) append({{"orange: tracked without earlier frames", kEstimatedOutline}});
  if (in_run.status == TrackStatus::tracked) append({{"blue: in the run", kRunOutline}});
  append({{""},
          {"E: mean distance from a glove pixel of the tiny"},
          {"image to the entry's nearest pixel of its color,"},
          {"in pixels; 0 is equal (equation 2)"}});
  lines.push_back({""});
  if (alone) append(errors_alone(*alone));
  append(errors_in_run(in_run));
  return render::picture_of_text(lines, kCellWidth, kCellHeight);
}

std::string depth_title(const TrackResult& result) {
  return fmt::format("depth, {} cloud points", result.cloud_points);
}

constexpr int kColumns = 16;
// Multiples of 16, since a JPEG shares colors in blocks of 16 x 16 px and tiles must not share any.
constexpr int kTileWidth = 240, kTileHeight = 192;
constexpr int kKeyframeQuality = 80;

/// Bounding box of the hand in the image, with a margin.
Eigen::AlignedBox2d box_of_hand(const PinholeCamera& camera, const HandModel& hand,
                                std::span<const HandFrame> frames) {
  Eigen::AlignedBox2d box;
  for (const HandFrame& frame : frames)
    for (const Eigen::Vector3f& p_hand : hand.pose(frame.posture).vertices)
      box.extend(camera.project(frame.T_camera_hand * p_hand.cast<double>()));
  constexpr double kMargin = 0.08;  // of the box, so that an estimate beside the truth is visible
  const Eigen::Vector2d margin = kMargin * box.sizes();
  return {box.min() - margin, box.max() + margin};
}

void paste(ColorImage& sheet, const ColorImage& tile, int column, int row) {
  for (int v = 0; v < tile.height(); ++v) {
    const int left = column * tile.width(), top = row * tile.height() + v;
    std::copy_n(tile.data() + static_cast<ptrdiff_t>(v) * tile.width(), tile.width(),
                sheet.data() + static_cast<ptrdiff_t>(top) * sheet.width() + left);
  }
}

class TilePainter {
 public:
  TilePainter(std::shared_ptr<const HandModel> hand, const PinholeCamera& camera)
      : hand_(std::move(hand)), camera_(camera), color_({camera, camera}, hand_, {}) {}

  ColorImage truth(const HandFrame& frame) {
    return color_.render(hand_->pose(frame.posture), frame.T_camera_hand, {}).color;
  }
  ColorImage difference(const HandFrame& frame, const Estimate& estimate) {
    const DepthImage truth = depth(frame.posture, frame.T_camera_hand);
    const DepthImage estimated = estimate.status == TrackStatus::tracked
                                     ? depth(estimate.posture, estimate.T_camera_hand)
                                     : DepthImage(camera_.width, camera_.height);
    return render::picture_of_depth_difference(truth, estimated, reports::kSheetDifferenceMm / 1000);
  }

 private:
  DepthImage depth(const Posture& posture, const Eigen::Isometry3d& T_camera_hand) {
    return ids_.render_ids(*hand_, hand_->pose(posture), camera_, T_camera_hand).depth;
  }

  std::shared_ptr<const HandModel> hand_;
  PinholeCamera camera_;
  render::RgbdRenderer color_;
  render::LabelRenderer ids_;
};

}  // namespace

ColorImage explain_frame(Workbench& workbench, const RunSpec& spec, const reports::FrameRecord& in_run,
                         const std::optional<HandFrame>& hand_in_run) {
  const int frame = in_run.frame;
  const int count = static_cast<int>(spec.trajectory->frames.size());
  if (frame < 0 || frame >= count)
    throw Error(spec.trajectory->name, "frame", std::to_string(frame), fmt::format("0 to {}", count - 1));
  const OneFrame taken = take_frame(workbench, spec, frame);
  const std::shared_ptr<const Database> database = workbench.database(spec.database);
  const TrackResult result = workbench.make_method(spec.tracker, spec.database)->track(taken.frame);
  const FrameTrace trace = inspect(taken.frame, workbench.calibration(),
                                   *workbench.color_table(spec.tracker.segmentation.color_space), spec.tracker);

  const auto cropped = [&](const ColorImage& image) {
    return render::crop_to_labels(image, taken.truth.label, kMargin);
  };
  std::vector<render::Panel> panels = {
      {fmt::format("{} frame {}: color camera", spec.trajectory->name, frame), taken.frame.color},
      {depth_title(result), render::picture_of_depth(trace.depth, 0.4, 1.8)},
      {"mapped image M", cropped(trace.mapped.color)},
      {"labels L in the working volume", cropped(render::picture_of_labels(trace.cloud.labels))},
      {"true labels", cropped(render::picture_of_labels(taken.truth.label))}};
  if (!trace.tiny.empty())
    panels.push_back(
        {fmt::format("tiny image {0} x {0}", trace.tiny.width()), render::picture_of_labels(trace.tiny)});
  for (const Match& match : result.matches) {
    const int posture = match.entry / kViewCount;
    panels.push_back({fmt::format("{}, view {}: E {:.2f} px", database->posture_set().posture_names[posture],
                                  Database::view(match.entry), match.error),
                      render::picture_of_labels(database->labels(trace.tiny.width(), match.entry))});
  }
  const HandModel& model = *workbench.model();
  const auto outlined = [&](const std::vector<Outline>& hands) {
    return cropped(overlay(model, hands, trace, taken.truth.label, workbench.calibration().ir));
  };
  std::vector<Outline> hands;
  if (hand_in_run) hands = {{hand_in_run->posture, hand_in_run->T_camera_hand, kRunOutline}};
  std::optional<reports::FrameErrors> errors;
  if (result.status == TrackStatus::tracked) {
    errors = reports::measure_frame(
        frame, result,
        {spec.trajectory->frames[frame].posture, spec.trajectory->frames[frame].T_camera_hand,
         workbench.subject(spec.subject).joints(spec.trajectory->frames[frame].posture),
         reports::count_patches(taken.truth.patch)},
        model);
    // Tracked alone, it was looked up.
    const Posture coarse =
        interpolate(*database, result.matches, std::nullopt, spec.tracker.lookup.interpolation_epsilon).posture;
    panels.push_back({"coarse pose over M", outlined({{coarse, result.T_camera_hand_coarse, kEstimatedOutline}})});
    // Above the other, which it often equals.
    hands.push_back({result.posture_unfiltered, result.T_camera_hand_unfiltered, kEstimatedOutline});
    panels.push_back({fmt::format("after {} iterations, {:.1f} mm off", result.icp_iterations,
                                  *errors->record["position_error_mm"]),
                      outlined(hands)});
  } else {
    panels.push_back(
        {fmt::format("{}: {}", hand_in_run ? "lost without earlier frames" : "lost", to_string(result.status)),
         outlined(hands)});
  }
  panels.push_back({"legend", legend(errors, in_run)});
  return render::montage(panels, kPanelColumns, kCellWidth, kCellHeight);
}

reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const reports::RunResult& result,
                                    const std::vector<reports::ExperimentEstimates>& estimates) {
  reports::PageMaterial material{page_scripts(), make_sheets(workbench, plan, result, estimates), {}};
  material.warnings = unit_warnings(plan);
  if (!plan.score.is_null()) {
    for (const auto& warning : plan.score.at("warnings")) material.warnings.push_back(warning.get<std::string>());
    return material;
  }
  material.from_files = inputs_from_files(plan);
  if (shows_stages(plan.tracker.method))
    material.worst_frames = picture_worst_frames(workbench, plan, result, estimates, material.from_files);
  for (const std::string& warning : lost_hand_warnings(plan, result, ".")) material.warnings.push_back(warning);
  return material;
}

PinholeCamera camera_around(const PinholeCamera& ir, const HandModel& hand, std::span<const HandFrame> frames,
                            int tile_width, int tile_height) {
  check(!frames.empty(), "a window is around the hand of some frame");
  const Eigen::AlignedBox2d box = box_of_hand(ir, hand, frames);
  const double scale = std::min(tile_width / box.sizes().x(), tile_height / box.sizes().y());
  // Pixel centers have integer coordinates, so a tile's middle is at (width - 1) / 2.
  return {tile_width,
          tile_height,
          ir.fx * scale,
          ir.fy * scale,
          (ir.cx - box.center().x()) * scale + (tile_width - 1) / 2.0,
          (ir.cy - box.center().y()) * scale + (tile_height - 1) / 2.0};
}

FrameSheet make_frame_sheet(Workbench& workbench, const std::string& figure, std::span<const HandFrame> frames,
                            std::span<const Estimate> estimates) {
  check(frames.size() == estimates.size(), "a sheet has an estimate for each frame");
  // Recorded truths are of subject 1, whose hand is the tracker's.
  const std::shared_ptr<const HandModel> hand = workbench.model();
  TilePainter painter(hand, camera_around(workbench.calibration().ir, *hand, frames, kTileWidth, kTileHeight));
  const auto count = static_cast<int>(frames.size());
  const int rows = (count + kColumns - 1) / kColumns;
  ColorImage sheet(kColumns * kTileWidth, 2 * rows * kTileHeight);
  for (int i = 0; i < count; ++i) {
    paste(sheet, painter.truth(frames[i]), i % kColumns, 2 * (i / kColumns));
    paste(sheet, painter.difference(frames[i], estimates[i]), i % kColumns, 2 * (i / kColumns) + 1);
  }
  return {figure, encode_jpeg(sheet, kKeyframeQuality), kColumns, kTileWidth, kTileHeight, estimates.front().frame,
          count};
}

}  // namespace glovebench::eval
