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
  std::string calibration;  ///< to read
  ColorSpace space = ColorSpace::yuv;
  std::vector<LabelErrors> errors;  ///< one per lighting
};

constexpr std::array<ColorSpace, 2> kSpaces = {ColorSpace::yuv, ColorSpace::rgb};
/// Indices of tables in measure_light; "own" is the tracker's, "one" calibrated under one lighting.
constexpr size_t kOwnYuv = 0, kOwnRgb = 1, kOneYuv = 2, kOneRgb = 3;

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
      "held out come from directions that no calibration has seen.",
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

double wrong_percent(const LabelErrors& errors) {
  return 100 * errors.wrong_share();
}
double missed_percent(const LabelErrors& errors) {
  return 100 * errors.missed_share();
}

double mislabeled_percent(const LabelErrors& errors) {
  return 100 * errors.mislabeled_share();
}

/// Over the held-out lightings, which come first.
double mean_over(std::span<const LabelErrors> errors, double (*percent)(const LabelErrors&)) {
  double sum = 0;
  for (const LabelErrors& of_lighting : errors) sum += percent(of_lighting);
  return sum / static_cast<double>(errors.size());
}

void add_light_rows(Table& table, const LightResult& result, std::span<const Lighting> lightings) {
  const std::string space(to_string(result.space));
  const size_t held_out = lightings.size() - 1;
  for (size_t i = 0; i < lightings.size(); ++i)
    table.rows.push_back({result.calibration, space,
                          i < held_out ? "held out" : "that of the one-lighting calibration", lightings[i].strength,
                          lightings[i].temperature_k, wrong_percent(result.errors[i]),
                          missed_percent(result.errors[i]), mislabeled_percent(result.errors[i])});
  const auto rest = std::span(result.errors).first(held_out);
  table.rows.push_back({result.calibration, space, "mean of those held out", Cell(), Cell(),
                        mean_over(rest, wrong_percent), mean_over(rest, missed_percent),
                        mean_over(rest, mislabeled_percent)});
}

Measure rgb_excess(const std::string& name, const LightResult& rgb, const LightResult& yuv, int held_out) {
  const auto excess = [&](std::span<const int> drawn) -> std::optional<double> {
    double sum = 0;
    for (const int i : drawn) sum += mislabeled_percent(rgb.errors[i]) - mislabeled_percent(yuv.errors[i]);
    return sum / static_cast<double>(drawn.size());
  };
  std::vector<int> all(held_out);
  std::iota(all.begin(), all.end(), 0);
  return {name, "percent", excess(all), interval_over(held_out, "held-out lightings", excess)};
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
  const Runs runs = run_settings(context, settings, {database}, reports::TruthKind::source, {"Tr4"});
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
std::vector<LightResult> measure_light(Workbench& workbench, std::span<const Lighting> lightings) {
  const auto postures = trajectories::posture_set(trajectory_folder(), "DB_open_pinch_power").postures;
  std::vector<LightResult> results;
  std::vector<std::shared_ptr<const ColorTable>> tables;
  for (const ColorSpace space : kSpaces) {
    results.push_back({"nine lightings, relit", space, {}});
    tables.push_back(workbench.color_table(space));
  }
  for (const ColorSpace space : kSpaces) {
    results.push_back({"one lighting, not relit", space, {}});
    tables.push_back(std::make_shared<ColorTable>(
        calibrate_colors(workbench.model(), workbench.calibration(), postures, one_lighting(space))));
  }
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
  return {"light",
          "Light",
          {std::move(table), tracking_table(context)},
          {rgb_excess("light.rgb_excess_percent", results[kOneRgb], results[kOneYuv], held_out),
           rgb_excess("light.rgb_excess_own_percent", results[kOwnRgb], results[kOwnYuv], held_out)}};
}

}  // namespace glovebench::eval
