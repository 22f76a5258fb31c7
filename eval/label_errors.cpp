#include "eval/label_errors.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/kinect/disparity.h"
#include "core/segmentation/color_table.h"
#include "eval/program.h"
#include "render/synthetic_kinect.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

std::vector<HandFrame> sample_frames() {
  std::vector<HandFrame> frames;
  for (const char* name : {"Tr1", "Tr4"}) {
    const auto trajectory = trajectories::source_trajectory(trajectory_folder(), name);
    for (const int f : {10, 70}) frames.push_back(trajectory.frames[f]);
  }
  return frames;
}

bool is_interior(const LabelImage& labels, int u, int v) {
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du)
      if (!labels.contains(u + du, v + dv) || labels(u + du, v + dv) != labels(u, v)) return false;
  return true;
}

}  // namespace

std::vector<render::Lighting> held_out_lightings() {
  const std::vector<Eigen::Vector3d> directions = {
      {0.6, 0.3, -0.74}, {-0.6, 0.2, -0.77}, {0, -0.7, -0.71}, {0, 0, -1}};
  std::vector<render::Lighting> lightings;
  for (const double strength : {0.5, 0.85, 1.2, 2.0}) {
    for (const double temperature_k : {3000.0, 4000.0, 5000.0, 6500.0}) {
      const size_t i = lightings.size();
      lightings.push_back({directions[(i + i / 4) % directions.size()], strength, temperature_k});
    }
  }
  return lightings;
}

double LabelErrors::wrong_share() const { return static_cast<double>(wrong) / std::max(1, labeled); }

double LabelErrors::missed_share() const {
  check(glove > 0, "a share of the glove is asked where it is seen");
  return static_cast<double>(missed) / glove;
}

double LabelErrors::mislabeled_share() const {
  check(glove > 0, "a share of the glove is asked where it is seen");
  return static_cast<double>(mislabeled) / glove;
}

double LabelErrors::interior_mislabeled_share() const {
  check(interior > 0, "a share of the interior is asked where it is seen");
  return static_cast<double>(interior_mislabeled) / interior;
}

double LabelErrors::border_mislabeled_share() const {
  check(glove > interior, "a share of the border is asked where it is seen");
  return static_cast<double>(mislabeled - interior_mislabeled) / (glove - interior);
}

double LabelErrors::missed_share_of(int color) const {
  return static_cast<double>(missed_of[color]) / std::max(1, glove_of[color]);
}

int LabelErrors::worst_color() const {
  int worst = 1;
  for (int color = 2; color <= kColorCount; ++color)
    if (missed_share_of(color) > missed_share_of(worst)) worst = color;
  return worst;
}

LabelErrors& LabelErrors::operator+=(const LabelErrors& other) {
  glove += other.glove;
  missed += other.missed;
  labeled += other.labeled;
  wrong += other.wrong;
  mislabeled += other.mislabeled;
  interior += other.interior;
  interior_missed += other.interior_missed;
  interior_mislabeled += other.interior_mislabeled;
  for (size_t color = 0; color < glove_of.size(); ++color) {
    glove_of[color] += other.glove_of[color];
    missed_of[color] += other.missed_of[color];
  }
  return *this;
}

LabelErrors label_errors(const render::RgbdImages& truth, const DeviceFrame& frame,
                         const RgbdCalibration& calibration, const ColorTable& table, LabelFilter filter) {
  const TrackerConfig config = profile("paper");
  const DepthImage depth = depth_from_disparity(frame.raw_disparity);
  const RegisteredImage mapped = register_color(depth, frame.color, calibration, config.registration);
  LabelImage of_image = segment(mapped, table);
  if (filter == LabelFilter::majority) of_image = majority_filter(of_image);
  if (filter == LabelFilter::surface) of_image = surface_majority(of_image, depth);
  const LabelImage labels = build_cloud(depth, of_image, calibration.ir, config.volume).labels;
  LabelErrors errors;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (truth.label[i] != 0 && mapped.has_color[i] != 0) {
      const bool missed = labels[i] == 0, mislabeled = labels[i] != truth.label[i];
      const bool interior =
          is_interior(truth.label, static_cast<int>(i) % labels.width(), static_cast<int>(i) / labels.width());
      ++errors.glove;
      ++errors.glove_of[truth.label[i]];
      errors.missed += missed;
      errors.mislabeled += mislabeled;
      errors.interior += interior;
      errors.interior_missed += interior && missed;
      errors.interior_mislabeled += interior && mislabeled;
      errors.missed_of[truth.label[i]] += missed;
    }
    errors.labeled += labels[i] != 0;
    errors.wrong += labels[i] != 0 && labels[i] != truth.label[i];
  }
  return errors;
}

std::vector<std::vector<LabelErrors>> measure_label_errors(
    Workbench& workbench, int subject, std::span<const render::Lighting> lightings,
    std::span<const std::shared_ptr<const ColorTable>> tables) {
  const render::Subject hand = workbench.subject(subject);
  const RgbdCalibration& calibration = workbench.calibration();
  render::SceneConfig scene;
  scene.shader = render::shader_of(subject);
  render::RgbdRenderer renderer(calibration, hand, scene);
  const std::vector<HandFrame> frames = sample_frames();
  std::vector<std::vector<LabelErrors>> errors;
  int64_t view = 0;
  for (const render::Lighting& lighting : lightings) {
    std::vector<LabelErrors>& of_lighting = errors.emplace_back(tables.size());
    for (const HandFrame& frame : frames) {
      const render::RgbdImages images = renderer.render(hand.pose(frame.posture), frame.T_camera_hand, lighting);
      const DeviceFrame device_frame =
          render::make_device_frame(images, calibration, 0, {}, {1, "label errors", view++});
      for (size_t t = 0; t < tables.size(); ++t)
        of_lighting[t] += label_errors(images, device_frame, calibration, *tables[t]);
    }
  }
  return errors;
}

}  // namespace glovebench::eval
