#include "eval/studies/light_curves.h"

#include <algorithm>
#include <optional>

#include "core/base/error.h"
#include "core/calibration/glove_colors.h"
#include "core/kinect/disparity.h"
#include "eval/program.h"
#include "eval/threads.h"
#include "render/lighting.h"
#include "render/synthetic_kinect.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Table;

/// Frames spread evenly over these movements.
std::vector<HandFrame> spread_frames(const std::vector<std::string>& names, int of_each) {
  std::vector<HandFrame> frames;
  for (const std::string& name : names) {
    const auto trajectory = trajectories::source_trajectory(trajectory_folder(), name);
    const size_t count = trajectory.frames.size();
    for (int i = 0; i < of_each; ++i) frames.push_back(trajectory.frames[(2 * i + 1) * count / (2 * of_each)]);
  }
  return frames;
}

/// A device frame with its true images.
struct TrueFrame {
  render::RgbdImages images;
  DeviceFrame frame;
};

std::vector<TrueFrame> render_under(Workbench& workbench, int subject, const LightPoint& point,
                                    const std::vector<HandFrame>& poses, const std::string& sequence) {
  const render::Subject hand = workbench.subject(subject);
  render::SceneConfig scene;
  scene.shader = render::shader_of(subject);
  render::RgbdRenderer renderer(workbench.calibration(), hand, scene);
  std::vector<TrueFrame> frames;
  for (const HandFrame& pose : poses) {
    TrueFrame& made = frames.emplace_back();
    made.images = renderer.render(hand.pose(pose.posture), pose.T_camera_hand, point.lighting);
    made.images.color = render::with_white_balance(made.images.color, point.white_balance);
    const auto number = static_cast<int64_t>(frames.size());
    made.frame =
        render::make_device_frame(made.images, workbench.calibration(), 33'333 * number, {}, {1, sequence, number});
  }
  return frames;
}

/// The best possible table for these pixels: each cell gets its most frequent label.
ColorTable best_table(const std::vector<TrueFrame>& frames, const RgbdCalibration& calibration) {
  std::vector<std::array<int, kColorCount + 1>> counts(ColorTable::kCells);
  for (const TrueFrame& frame : frames) {
    const DepthImage depth = depth_from_disparity(frame.frame.raw_disparity);
    const RegisteredImage mapped = register_color(depth, frame.frame.color, calibration, {});
    for (size_t i = 0; i < depth.size(); ++i)
      if (mapped.has_color[i] != 0)
        ++counts[ColorTable::cell_of_rgb(mapped.color[i], ColorSpace::yuv)][frame.images.label[i]];
  }
  std::vector<uint8_t> labels(ColorTable::kCells, 0);
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    const auto most = std::max_element(counts[cell].begin() + 1, counts[cell].end());
    if (*most > 0) labels[cell] = static_cast<uint8_t>(most - counts[cell].begin());
  }
  return ColorTable(std::move(labels));
}

/// The table that `calibrate colors` makes of a recording under this light; empty if it refuses.
std::optional<ColorTable> recalibrated(Workbench& workbench, int subject, const LightPoint& point) {
  constexpr int kFrames = 24;
  const calibration::ColorSamples samples = record_under(workbench, subject, point, kFrames);
  try {
    const auto seeds = calibration::seeds_of_table(*workbench.color_table(), "the tracker's own color table");
    return build_color_table(samples, fit_glove_colors(samples, seeds, "the recording"));
  } catch (const Error&) {
    return {};  // a refusal is a result of the curve
  }
}

LightPoint strength_of(double strength) { return {.value = strength, .lighting = {.strength = strength}}; }
LightPoint temperature_of(double kelvin) { return {.value = kelvin, .lighting = {.temperature_k = kelvin}}; }
LightPoint green_gain_of(double gain) {
  return {.value = gain, .lighting = {}, .white_balance = Eigen::Vector3d(1, gain, 1)};
}

template <typename Make>
std::vector<LightPoint> points_of(const std::vector<double>& values, Make make) {
  std::vector<LightPoint> points;
  for (const double value : values) points.push_back(make(value));
  return points;
}

Table empty_light_table(const LightAxis& axis) {
  return {
      axis.table,
      axis.title,
      "Pixels of the glove that get their own label, another (wrong) or none (missed). Border: pixels with another "
      "true "
      "label beside them, most of which mix two colors. Own table: the tracker's. Recalibrated: by calibrate "
      "colors from "
      "a recording under that light, other movements. Majority: the filter of all labels in 3 x 3 pixels; surface "
      "majority: of those on the same surface that have one. Best table: counted from the true labels of these "
      "very "
      "pixels, for comparison.",
      {{"labels", "labels"},
       {axis.column, axis.heading, 3},
       {"right_percent", "right %"},
       {"not_right_percent", "not right %"},
       {"wrong_percent", "wrong %"},
       {"missed_percent", "missed %"},
       {"interior_right_percent", "right inside %"},
       {"border_right_percent", "right at borders %"},
       {"border_percent", "border, of the glove %"}},
      2,
      {}};
}

std::vector<Cell> row_of(const LightWay& way, double value) {
  if (!way.errors) return {way.name, value, Cell(), Cell(), Cell(), Cell(), Cell(), Cell(), Cell()};
  const LabelErrors& errors = *way.errors;
  const auto percent = [&](double count) { return 100 * count / errors.glove; };
  return {way.name,
          value,
          100 - 100 * errors.mislabeled_share(),
          100 * errors.mislabeled_share(),
          percent(errors.mislabeled - errors.missed),
          percent(errors.missed),
          100 - 100 * errors.interior_mislabeled_share(),
          100 - 100 * errors.border_mislabeled_share(),
          percent(errors.glove - errors.interior)};
}

/// Half to double strength, 3000 to 6500 K, an undrifted white balance.
bool is_usual(const LightPoint& point) {
  return point.lighting.strength >= 0.5 && point.lighting.strength <= 2 && point.lighting.temperature_k >= 3000 &&
         point.lighting.temperature_k <= 6500 && point.white_balance == Eigen::Vector3d::Ones();
}

/// Means of each way over the usual lights: light_curves.own_table_right_percent etc.
std::vector<reports::Measure> mean_measures(const std::vector<LightAxis>& axes,
                                            const std::vector<std::vector<std::vector<LightWay>>>& ways) {
  const std::vector<std::string> names = {"own_table",    "own_table_majority",   "own_table_surface",
                                          "recalibrated", "recalibrated_surface", "best_table"};
  std::vector<reports::Measure> measures;
  for (size_t w = 0; w < names.size(); ++w) {
    double sum = 0;
    int count = 0, missing = 0;
    for (size_t a = 0; a < axes.size(); ++a)
      for (size_t p = 0; p < axes[a].points.size(); ++p) {
        if (!is_usual(axes[a].points[p])) continue;
        const std::optional<LabelErrors>& errors = ways[a][p].at(w).errors;
        ++count;
        missing += !errors;
        if (errors) sum += 100 - 100 * errors->mislabeled_share();
      }
    std::optional<double> mean;
    if (count > 0 && missing == 0) mean = sum / count;
    measures.push_back({"light_curves." + names[w] + "_right_percent", "percent", mean, {}});
  }
  return measures;
}

}  // namespace

std::vector<LightAxis> light_axes(bool quick) {
  using Values = std::vector<double>;
  return {{"light_strength", "Labels against the strength of the light", "strength", "strength",
           points_of(quick ? Values{0.5, 1} : Values{0.125, 0.177, 0.25, 0.354, 0.5, 0.707, 1, 1.414, 2, 2.828, 4},
                     strength_of)},
          {"light_temperature", "Labels against the color temperature of the light", "temperature_k", "K",
           points_of(quick ? Values{3000, 6500} : Values{2000, 2500, 3000, 3500, 4000, 5000, 6500, 8000, 10000},
                     temperature_of)},
          {"light_white_balance", "Labels against a drift of the white balance", "green_gain", "gain of green",
           points_of(quick ? Values{0.8, 1.25} : Values{0.6, 0.7, 0.8, 0.9, 1, 1.111, 1.25, 1.429, 1.667},
                     green_gain_of)}};
}

calibration::ColorSamples record_under(Workbench& workbench, int subject, const LightPoint& point, int frames) {
  const std::vector<std::string> movements = {"Tr2", "Tr3", "Tr5"};
  const auto poses = spread_frames(movements, frames / static_cast<int>(movements.size()));
  calibration::ColorSamples samples;
  for (const TrueFrame& frame : render_under(workbench, subject, point, poses, "color recording"))
    samples.add_frame(frame.frame, workbench.calibration());
  return samples;
}

std::vector<LightWay> measure_light_point(Workbench& workbench, int subject, const LightPoint& point) {
  const auto poses = spread_frames({"Tr1", "Tr4"}, 4);
  const std::vector<TrueFrame> frames = render_under(workbench, subject, point, poses, "light curves");
  const auto measured = [&](const ColorTable& table, LabelFilter filter) {
    LabelErrors errors;
    for (const TrueFrame& frame : frames)
      errors += label_errors(frame.images, frame.frame, workbench.calibration(), table, filter);
    return errors;
  };
  const std::shared_ptr<const ColorTable> standard = workbench.color_table();
  std::vector<LightWay> ways = {{"own table", measured(*standard, LabelFilter::none)},
                                {"own table, majority", measured(*standard, LabelFilter::majority)},
                                {"own table, surface majority", measured(*standard, LabelFilter::surface)},
                                {"recalibrated", {}},
                                {"recalibrated, surface majority", {}}};
  if (const std::optional<ColorTable> table = recalibrated(workbench, subject, point)) {
    ways[3].errors = measured(*table, LabelFilter::none);
    ways[4].errors = measured(*table, LabelFilter::surface);
  }
  ways.push_back({"best table", measured(best_table(frames, workbench.calibration()), LabelFilter::none)});
  return ways;
}

reports::StudyResult run_light_curves(const StudyContext& context) {
  const std::vector<LightAxis> axes = light_axes(context.options.quick);
  context.workbench.subject(1);
  context.workbench.color_table();                                    // before the threads need it
  std::vector<std::vector<std::vector<LightWay>>> ways(axes.size());  // [axis][point][way]
  std::vector<std::pair<size_t, size_t>> places;
  for (size_t a = 0; a < axes.size(); ++a) {
    ways[a].resize(axes[a].points.size());
    for (size_t p = 0; p < axes[a].points.size(); ++p) places.emplace_back(a, p);
  }
  in_parallel(context.workbench.config().threads, places.size(), [&](size_t i) {
    const auto [a, p] = places[i];
    ways[a][p] = measure_light_point(context.workbench, 1, axes[a].points[p]);
  });
  reports::StudyResult result{"light_curves", "Light", {}, mean_measures(axes, ways)};
  for (size_t a = 0; a < axes.size(); ++a) {
    Table& table = result.tables.emplace_back(empty_light_table(axes[a]));
    for (size_t w = 0; w < ways[a].front().size(); ++w)
      for (size_t p = 0; p < axes[a].points.size(); ++p)
        table.rows.push_back(row_of(ways[a][p][w], axes[a].points[p].value));
  }
  return result;
}

}  // namespace glovebench::eval
