#include "eval/studies/deviations.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/error.h"
#include "eval/plan.h"

namespace glovebench::eval {
namespace {

using reports::Row;
using reports::Table;

constexpr double kAlways = 1e6;  ///< a limit that no frame reaches

constexpr auto kDeviations = std::to_array<Deviation>({
    {"hand mesh", "\"a virtual hand model textured with the glove's color pattern\" (III), not published",
     "the hand of the WebXR input profiles", "not measured: subjects 2 to 22 change the rendered hand instead"},
    {"patch layout", "\"a pattern of 20 patches in 10 distinguishable colors\" (III), shown in photographs",
     "20 patches with borders of our own", "not measured: the paper's borders are not published"},
    {"dyes", "\"10 distinguishable colors\" (III), without values", "ten colors chosen to be told apart",
     "not measured: the paper's values are not published"},
    {"wrist", "\"16 flexion angles and 6 abduction angles for each of the finger bases and the wrist joint\" (III)",
     "the databases' wrists are straight, those of the movements are not",
     "not measured: the paper's postures are not published"},
    {"postures", "\"17 random movement postures\" (IV), \"a low-dispersion sampling method\" (III)",
     "17 by low dispersion, from blends of 18 gestures",
     "not measured here: table postures of --only ablations has random ones"},
    {"view camera", "\"42 camera positions with 18 rotations\" (III), without distance and angle of view",
     "0.75 m, 24 degrees", "not measured: the paper gives no number"},
    {"occlusion",
     "\"an RGBD-mapping, which maps color values to the pixel coordinates of the depth image\" (III-A)",
     "no color for a pixel that another surface hides from the color camera", "a color for each pixel",
     [](RunSpec& spec) { spec.tracker.registration.occlusion_tolerance = kAlways; }},
    {"color table", "\"a lookup table-based color segmentation procedure\" (III-A), without its calibration",
     "calibrated under nine lightings",
     "not measured here: table light of --only ablations has tables from one lighting"},
    {"volume", "z in \"[zmin, zmax]\" (equation 1), without numbers", "0.40 to 0.95 m",
     "0.50 to 0.90 m; farther away the scene has clutter in similar colors",
     [](RunSpec& spec) { spec.tracker.volume = {.z_min = 0.50, .z_max = 0.90}; }},
    {"loss gates", "no words",
     "a frame is lost if the hand is small or cut, a second one is in view, or the fit is poor",
     "no such frame is lost",
     [](RunSpec& spec) {
       spec.tracker.detection.min_pixels = 3;
       spec.tracker.detection.second_hand_share = 1;
       spec.tracker.detection.max_border_pixels = 307'200;
       spec.tracker.detection.max_border_share = kAlways;
       spec.tracker.lookup.max_matching_error = kAlways;
       spec.tracker.max_residual = kAlways;
     }},
    {"cap", "the distance to the nearest pixel of the color (equation 2), however far it is",
     "at most half of the tiny image's side", "at most the whole side",
     [](RunSpec& spec) { spec.tracker.views.field_cap_share = 1; }},
    {"absent colors",
     "\"the set of pixel coordinates in image B that have the same color\" (equation 2), if not empty",
     "the cap, if it is empty", "not measured alone: the equation has no value; cap doubles this one, too"},
    {"weights", "\"weighting the contributions of [postures and rotations] with their matching error\" (III-B)",
     "1 / (error + 0.01 px)", "equal weights",
     [](RunSpec& spec) { spec.tracker.lookup.interpolation_epsilon = kAlways; }},
    {"rotation mean", "the rotations are \"interpolated\" (III-B)", "the mean of quaternions by Markley et al.",
     "not measured: the paper names no other mean"},
    {"box's ray", "\"the coarse rotation estimate [...] is mapped to the world coordinate frame\" (III-C)",
     "turned from the ray through the view's box to that through the image's", "not turned",
     [](RunSpec& spec) { spec.tracker.lookup.turn_to_ray = false; }},
    {"start", "\"the center of gravity (COG) of C is computed. This yields a coarse pose estimate\" (III-C)",
     "the center of the visible faces lies there", "the hand's origin lies there",
     [](RunSpec& spec) { spec.tracker.icp.center_visible_surface = false; }},
    {"points", "\"we uniformly sub-sample the sensor point cloud\" (IV-C), without a factor",
     "every nth point, at most 1,000", "all points",
     [](RunSpec& spec) { spec.tracker.icp.subsampling_factor = 1; }},
    {"convergence", "\"repeated until the alignment error converges\" (III-C)",
     "until it changes by at most 0.1%, at most 100 times", "0.0001%, 10,000 times",
     [](RunSpec& spec) {
       spec.tracker.icp.convergence_share = 1e-6;
       spec.tracker.icp.max_iterations = 10'000;
     }},
    {"filter",
     "\"we smooth the posture and pose estimation by interpolating with estimations from the three previous "
     "frames\" (III-C)",
     "the posture alone, which keeps 3/4 of the previous one", "the pose, too: profile paper-literal",
     [](RunSpec& spec) { spec.tracker = profile("paper-literal"); }},
    {"noise gain",
     "\"Gaussian noise, whose variance was scaled with the gradient intensity image\" (IV), without a gain",
     "1.4 mm on a slant of 45 degrees at 0.7 m", "twice that variance",
     [](RunSpec& spec) { spec.noise.factor = 2; }},
    {"depth steps", "\"synthetic color and depth images\" (IV), no word on steps of depth", "a Kinect's, 11 bits",
     "not measured: the tracker reads nothing else"},
    {"movements", "\"five different movement trajectories\" (IV), not published",
     "five of our own; Tr4 has the length and onsets of Figure 5", "not measured: the suite families has others"},
    {"posture error", "\"Posture and rotation errors are given in deg\" (Figure 4), without a formula",
     "root mean square over the 22 angles", "not measured: it changes no answer"},
});

/// Source truths of Figure 4 with the tracker's own hand; a quick run has a stretch of one movement.
std::vector<RunSpec> undeviated_specs(const StudyOptions& study) {
  Figure4Options options;
  options.seeds = study.seeds;
  options.frames = frames_of(study);
  if (study.quick) options.trajectories = {"Tr4"};
  std::vector<RunSpec> specs = plan_figure4(profile("paper"), options).specs;
  std::erase_if(specs, [&](const RunSpec& spec) {
    return key_of(spec).truth != reports::TruthKind::source || spec.subject != 1 ||
           (study.quick && spec.database != "DB_open_power");
  });
  return specs;
}

bool has_other_views(const RunSpec& spec) {
  return spec.tracker.views.field_cap_share != ViewConfig{}.field_cap_share;
}

/// Each spec as it is and with each change; those with one view of the hand are neighbors, since they share images.
Runs run_deviations_of(const StudyContext& context, const std::vector<RunSpec>& specs) {
  std::vector<RunSpec> all, with_other_views;
  for (const RunSpec& spec : specs) {
    all.push_back(spec);
    for (const Deviation& deviation : kDeviations) {
      if (deviation.change == nullptr) continue;
      RunSpec changed = spec;
      deviation.change(changed);
      changed.setting = deviation.name;
      (has_other_views(changed) ? with_other_views : all).push_back(std::move(changed));
    }
  }
  Runs runs = run_specs(context, all);
  WorkbenchConfig other = context.workbench.config();
  other.views = with_other_views.front().tracker.views;
  Workbench workbench(other);
  append(runs, run_specs({workbench, context.options, context.store}, with_other_views));
  return runs;
}

Selection with_setting(const Runs& runs, std::string_view setting) {
  Selection selection;
  for (const MeasuredRun& run : runs)
    if (run.run.spec.setting == setting) selection.push_back(&run);
  return selection;
}

/// For each movement the mean change over the frames that both answer, all databases and seeds.
std::vector<double> changes_by_movement(const Selection& changed, const Selection& paper, std::string_view metric) {
  std::map<std::string, std::vector<double>> changes;
  for (size_t r = 0; r < changed.size(); ++r) {
    check(changed[r]->run.spec.trajectory->name == paper[r]->run.spec.trajectory->name &&
              changed[r]->run.spec.database == paper[r]->run.spec.database,
          "both runs are of one experiment");
    for (size_t f = 0; f < changed[r]->errors.size(); ++f) {
      const auto &with = changed[r]->errors[f].record[metric], &without = paper[r]->errors[f].record[metric];
      if (with && without) changes[changed[r]->run.spec.trajectory->name].push_back(*with - *without);
    }
  }
  std::vector<double> means;
  for (const auto& [movement, values] : changes) means.push_back(*reports::mean(values));
  return means;
}

Table empty_deviations_table() {
  Table table = {
      "deviations",
      "Deviations from the paper, and its gaps",
      "What profile \"paper\" does in another way than the paper says, or had to choose since the paper does not "
      "say it. Changes are those of the mean errors (position, posture as RMS over the 22 angles, rotation) if "
      "this one thing is done as the paper says, or otherwise: means over the movements of Figure 4 (source truth, "
      "the "
      "tracker's own hand, all databases with the grasp) of their mean changes, over the frames that both trackers "
      "answer. Low and high: 95% interval, Student's t over the movements; none if no frame changes. Covered: of "
      "all frames, tracked within 50 mm and 30 degrees.",
      {{"deviation", "deviation"}, {"paper", "the paper"}, {"ours", "ours"}, {"instead", "measured instead"}},
      4,
      {}};
  add_with_interval(table.columns, {"position_change_mm", "mm"});
  add_with_interval(table.columns, {"posture_change_deg", "posture"});
  add_with_interval(table.columns, {"rotation_change_deg", "rotation"});
  table.columns.push_back({"covered_percent", "cov. %", 1});
  return table;
}

}  // namespace

std::span<const Deviation> deviations() { return kDeviations; }

Table deviations_table(const Runs& runs) {
  Table table = empty_deviations_table();
  const Selection paper = with_setting(runs, "");
  for (const Deviation& deviation : kDeviations) {
    Row& row = table.rows.emplace_back(Row{std::string(deviation.name), std::string(deviation.paper),
                                           std::string(deviation.ours), std::string(deviation.instead)});
    if (deviation.change == nullptr) {
      row.resize(table.columns.size());
      continue;
    }
    const Selection changed = with_setting(runs, deviation.name);
    for (const char* metric : {"position_error_mm", "posture_rms_deg", "rotation_error_deg"}) {
      const std::vector<double> changes = changes_by_movement(changed, paper, metric);
      append(row, cells({reports::mean(changes), reports::student_interval(changes, "movements")}));
    }
    row.push_back(cell(covered_percent(changed)));
  }
  return table;
}

reports::StudyResult run_deviations(const StudyContext& context) {
  const Runs runs = run_deviations_of(context, undeviated_specs(context.options));
  return {"deviations", "Deviations from the paper, and its gaps", {deviations_table(runs)}, {}};
}

}  // namespace glovebench::eval
