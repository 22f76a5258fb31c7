#include <fmt/format.h>

#include "eval/color_table_cache.h"
#include "eval/label_errors.h"
#include "eval/program.h"
#include "eval/studies/study.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using render::Lighting;
using reports::Cell;
using reports::Measure;
using reports::Table;

/// A color table and its errors under each lighting.
struct LightResult {
  std::string calibration, space;  ///< to read
  std::shared_ptr<const ColorTable> table;
  std::vector<LabelErrors> errors = {};  ///< one per lighting
};

constexpr std::array<ColorSpace, 2> kSpaces = {ColorSpace::yuv, ColorSpace::rgb};
/// Indices of tables in light_tables; "own" is the tracker's, "one" calibrated under one lighting.
constexpr size_t kOwnYuv = 0, kOwnRgb = 1, kOwnEqual = 2, kOneYuv = 3, kOneRgb = 4, kOneEqual = 5;
/// Colors reach 68,183 of YUV's 262,144 cells, and all of RGB's: pooled by pairs in red and blue, RGB has 65,536.
constexpr std::array<int, 3> kPooledRgb = {2, 1, 2};

Table empty_light_table() {
  return {
      "light",
      "Labels under other light",
      "Wrong: share of the labeled pixels with another label than the true one. Missed: share of the glove's "
      "pixels without a label; where nearly all are missed, wrong is a share of very few. \"Nine lightings, "
      "relit\" is how the tracker's own tables are calibrated: under "
      "strengths 0.7 to 1.4 and 3500 to 5500 K, and with every color it saw relit by computation; \"one lighting, "
      "not relit\" is the plain look-up table, which shows what the color space itself is worth. Lightings that "
      "are "
      "held out come from directions that no calibration has seen. Colors fill 24% of the YUV cube and all of "
      "RGB's, so that RGB has four times as many cells for them; \"rgb, as many cells\" has 65,536, and 68,183 of "
      "YUV's can be reached.",
      {{"calibration", "calibration"},
       {"color_space", "color space"},
       {"lighting", "lighting"},
       {"strength", "strength"},
       {"temperature_k", "K", 0},
       {"wrong_percent", "wrong %"},
       {"missed_percent", "missed %"},
       {"mislabeled_percent", "wrong or missed, of the glove %"}},
      5,
      {}};
}

Table empty_tracking_table() {
  return {"light_tracking",
          "Tracking under other light",
          "Means over Tr4 (the movement itself) with DB_open_pinch_power and the tracker's own calibration.",
          {{"color_space", "color space"},
           {"strength", "strength"},
           {"temperature_k", "K", 0},
           {"position_error_mm", "position mm"},
           {"posture_error_deg", "posture deg"},
           {"rotation_error_deg", "rotation deg"},
           {"covered_percent", "covered %", 1}},
          3,
          {}};
}

double wrong_percent(const LabelErrors& errors) { return 100 * errors.wrong_share(); }
double missed_percent(const LabelErrors& errors) { return 100 * errors.missed_share(); }

double mislabeled_percent(const LabelErrors& errors) { return 100 * errors.mislabeled_share(); }

/// Over the held-out lightings, which come first.
double mean_over(std::span<const LabelErrors> errors, double (*percent)(const LabelErrors&)) {
  double sum = 0;
  for (const LabelErrors& of_lighting : errors) sum += percent(of_lighting);
  return sum / static_cast<double>(errors.size());
}

void add_light_rows(Table& table, const LightResult& result, std::span<const Lighting> lightings) {
  const size_t held_out = lightings.size() - 1;
  for (size_t i = 0; i < lightings.size(); ++i)
    table.rows.push_back({result.calibration, result.space,
                          i < held_out ? "held out" : "that of the one-lighting calibration", lightings[i].strength,
                          lightings[i].temperature_k, wrong_percent(result.errors[i]),
                          missed_percent(result.errors[i]), mislabeled_percent(result.errors[i])});
  const auto rest = std::span(result.errors).first(held_out);
  table.rows.push_back({result.calibration, result.space, "mean of those held out", Cell(), Cell(),
                        mean_over(rest, wrong_percent), mean_over(rest, missed_percent),
                        mean_over(rest, mislabeled_percent)});
}

Measure rgb_excess(const std::string& name, const LightResult& rgb, const LightResult& yuv, int held_out) {
  const auto excess = [&](std::span<const int> drawn) -> std::optional<double> {
    double sum = 0;
    for (const int i : drawn) sum += mislabeled_percent(rgb.errors[i]) - mislabeled_percent(yuv.errors[i]);
    return sum / static_cast<double>(drawn.size());
  };
  return measure_over(held_out, "held-out lightings", name, "percent", excess);
}

/// Half and double strength, warm and cold, from the default direction.
std::vector<Lighting> tracked_lightings(bool quick) {
  const auto lighting = [](double strength, double temperature_k) {
    return Lighting{.strength = strength, .temperature_k = temperature_k};
  };
  if (quick) return {lighting(0.5, 5000), lighting(1, 5000)};
  return {lighting(0.5, 5000), lighting(1, 5000), lighting(2, 5000), lighting(1, 3000), lighting(1, 6500)};
}

Table tracking_table(const StudyContext& context) {
  std::vector<Setting> settings;
  for (const Lighting& lighting : tracked_lightings(context.options.quick)) {
    for (const ColorSpace space : kSpaces) {
      Setting& setting = settings.emplace_back(
          Setting{.name = fmt::format("{} {} {} K", to_string(space), lighting.strength, lighting.temperature_k),
                  .tracker = context.options.tracker,
                  .lighting = lighting});
      setting.tracker.segmentation.color_space = space;
    }
  }
  const char* database = "DB_open_pinch_power";
  const Runs runs = run_study_settings(context, settings, {database}, reports::TruthKind::source, {"Tr4"});
  Table table = empty_tracking_table();
  for (const ColorSpace space : kSpaces) {
    for (const Setting& setting : settings) {
      if (setting.tracker.segmentation.color_space != space) continue;
      const Selection selected = select(runs, setting.name, database);
      std::vector<Cell> row = {std::string(to_string(space)), setting.lighting.strength,
                               setting.lighting.temperature_k};
      for (const char* metric : {"position_error_mm", "posture_rms_deg", "rotation_error_deg"})
        row.push_back(cell(mean(sample_of(selected, metric))));
      row.push_back(cell(covered_percent(selected)));
      table.rows.push_back(row);
    }
  }
  return table;
}

/// Order: calibration (the tracker's own, then under one lighting), then color space.
std::vector<LightResult> light_tables(Workbench& workbench) {
  const auto postures = trajectories::posture_set(trajectory_folder(), "DB_open_pinch_power").postures;
  const auto calibrated = [&](const ColorTableConfig& config) {
    return std::make_shared<const ColorTable>(
        calibrate_colors(workbench.model(), workbench.calibration(), postures, config));
  };
  ColorTableConfig own_equal, one_equal = one_lighting(ColorSpace::rgb);
  own_equal.space = ColorSpace::rgb;
  own_equal.model.pooled = one_equal.model.pooled = kPooledRgb;
  const std::string own = "nine lightings, relit", one = "one lighting, not relit", equal = "rgb, as many cells";
  return {{own, "yuv", workbench.color_table(ColorSpace::yuv)},
          {own, "rgb", workbench.color_table(ColorSpace::rgb)},
          {own, equal, calibrated(own_equal)},
          {one, "yuv", calibrated(one_lighting(ColorSpace::yuv))},
          {one, "rgb", calibrated(one_lighting(ColorSpace::rgb))},
          {one, equal, calibrated(one_equal)}};
}

std::vector<LightResult> measure_light(Workbench& workbench, std::span<const Lighting> lightings) {
  std::vector<LightResult> results = light_tables(workbench);
  std::vector<std::shared_ptr<const ColorTable>> tables;
  for (const LightResult& result : results) tables.push_back(result.table);
  for (const auto& of_lighting : measure_label_errors(workbench, 1, lightings, tables))
    for (size_t t = 0; t < tables.size(); ++t) results[t].errors.push_back(of_lighting[t]);
  return results;
}

}  // namespace

reports::StudyResult run_light(const StudyContext& context) {
  std::vector<Lighting> lightings = held_out_lightings();
  if (context.options.quick) lightings.resize(2);
  const auto held_out = static_cast<int>(lightings.size());
  lightings.push_back(one_lighting(ColorSpace::yuv).lightings.front());
  const std::vector<LightResult> results = measure_light(context.workbench, lightings);
  Table table = empty_light_table();
  for (const LightResult& result : results) add_light_rows(table, result, lightings);
  const auto excess = [&](const std::string& name, size_t rgb, size_t yuv) {
    return rgb_excess("light.rgb_excess_" + name, results[rgb], results[yuv], held_out);
  };
  return {
      "light",
      "Light",
      {std::move(table), tracking_table(context)},
      {excess("percent", kOneRgb, kOneYuv), excess("own_percent", kOwnRgb, kOwnYuv),
       excess("equal_cells_percent", kOneEqual, kOneYuv), excess("own_equal_cells_percent", kOwnEqual, kOwnYuv)}};
}

}  // namespace glovebench::eval
