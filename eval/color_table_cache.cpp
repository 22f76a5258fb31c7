#include "eval/color_table_cache.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "render/color_noise.h"
#include "render/rgbd_renderer.h"

namespace glovebench::eval {
namespace {

constexpr int kViewsPerLighting = 12;

/// A random pose in the working volume.
Eigen::Isometry3d random_pose(RandomStream& random) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  T_camera_hand.linear() = q.normalized().toRotationMatrix();
  const double x = random.uniform(-0.15, 0.15), y = random.uniform(-0.1, 0.1), z = random.uniform(0.55, 0.85);
  T_camera_hand.translation() = Eigen::Vector3d(x, y, z);
  return T_camera_hand;
}

std::string input_hash(const HandModel& model, const RgbdCalibration& calibration,
                       const std::vector<Posture>& postures, ColorSpace space) {
  std::string text = fmt::format("{}/{}/{}/{}/{}", color_table_source_hash(), to_string(space), kViewsPerLighting,
                                 model.hash(), calibration.rgb.fx);
  for (const Posture& posture : postures) text += fmt::format("/{}", fmt::join(posture, ","));
  for (const render::Lighting& l : calibration_lightings())
    text += fmt::format("/{},{},{}", l.strength, l.temperature_k, fmt::join(l.direction_to_light, ","));
  for (const Eigen::Vector3f& albedo : render::glove_albedos(render::Shader::first_subject))
    text += fmt::format("/{}", fmt::join(albedo, ","));
  return hash_text(text);
}

}  // namespace

std::vector<render::Lighting> calibration_lightings() {
  static const std::array<Eigen::Vector3d, 3> directions = {
      Eigen::Vector3d(-0.3, -0.4, -0.87), Eigen::Vector3d(0.5, -0.2, -0.84), Eigen::Vector3d(0.1, 0.5, -0.86)};
  std::vector<render::Lighting> lightings;
  for (const double strength : {0.7, 1.0, 1.4}) {
    for (const double temperature : {3500.0, 4500.0, 5500.0}) {
      render::Lighting lighting;
      lighting.direction_to_light = directions[lightings.size() % directions.size()];
      lighting.strength = strength;
      lighting.temperature_k = temperature;
      lightings.push_back(lighting);
    }
  }
  return lightings;
}

ColorTableConfig one_lighting(ColorSpace space) {
  render::Lighting lighting = calibration_lightings().front();
  lighting.strength = 1.0;
  lighting.temperature_k = 4500.0;
  ColorModel as_seen;
  as_seen.strength_factor = 1.0;
  as_seen.temperature_shift_mired = 0.0;
  return {space, {lighting}, as_seen};
}

ColorTable calibrate_colors(const std::shared_ptr<const HandModel>& model, const RgbdCalibration& calibration,
                            const std::vector<Posture>& postures, const ColorTableConfig& config) {
  // Some clutter on the table has nearly the glove's colors. It lies beyond the working volume, and learning it as
  // background would cost glove pixels.
  render::SceneConfig scene;
  scene.clutter = false;
  render::RgbdRenderer renderer(calibration, model, scene);
  ColorCalibration colors(config.space);
  int64_t view = 0;
  for (const render::Lighting& lighting : config.lightings) {
    for (int i = 0; i < kViewsPerLighting; ++i, ++view) {
      RandomStream random(1, "color calibration", view, "pose");
      const PosedHand hand = model->pose(postures[view % postures.size()]);
      const Eigen::Isometry3d T_camera_hand = random_pose(random);
      const ColorImage color = renderer.render(hand, T_camera_hand, lighting).color;
      colors.add_view(render::add_color_noise(color, render::kColorSigma_gray, {1, "color calibration", view}),
                      renderer.render_color_labels(hand, T_camera_hand));
    }
  }
  return colors.build(config.model);
}

ColorTable cached_color_table(const std::string& folder, const std::shared_ptr<const HandModel>& model,
                              const RgbdCalibration& calibration, const std::vector<Posture>& postures,
                              ColorSpace space) {
  const std::string hash = input_hash(*model, calibration, postures, space);
  const std::string path = fmt::format("{}/colors-{}.table", folder, hash.substr(0, 16));
  if (std::filesystem::exists(path)) {
    try {
      return ColorTable::load(path);
    } catch (const Error&) {
      // Made anew below.
    }
  }
  const ColorTable table = calibrate_colors(model, calibration, postures,
                                            {.space = space, .lightings = calibration_lightings(), .model = {}});
  table.save(path);
  return table;
}

}  // namespace glovebench::eval
