#include "eval/studies/ablations.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/error.h"
#include "eval/studies/light_curves.h"
#include "reports/statistics.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::SequenceMetrics;
using reports::Table;
using reports::TruthKind;

constexpr const char* kAblationDatabase = "DB_open_pinch_power";

/// The movements that a database can follow; empty: all.
std::vector<std::string> movements_for(const std::string& database) {
  std::vector<std::string> names;
  if (database == "DB_open_power") {
    for (const std::string& name : trajectories::ground_truth_names())
      if (trajectories::grasp_of(name) == "power") names.push_back(name);
  }
  return names;
}

/// Mean over movements and seeds with a value.
Cell sequence_cell(const Selection& runs, std::optional<double> SequenceMetrics::*metric) {
  std::vector<SequenceMetrics> all;
  for (auto& sequences : sequences_of(runs)) append(all, std::move(sequences));
  return cell(reports::mean_present(all, metric));
}

std::vector<Cell> row_of(const Runs& runs, const Ablation& ablation, const AblationRow& row) {
  const Selection selected = select(runs, row.setting, row.database);
  const AblationRow& first = ablation.rows.front();
  const Selection reference = select(runs, first.setting, first.database);
  std::vector<Cell> result = {ablation.name, row.label, row.database};
  append(result, error_cells(selected, &row == &first ? nullptr : &reference));
  result.push_back(cell(covered_percent(selected)));
  for (const auto metric : {&SequenceMetrics::jitter_position_mm, &SequenceMetrics::jitter_rotation_deg,
                            &SequenceMetrics::latency_frames})
    result.push_back(sequence_cell(selected, metric));
  return result;
}

Table empty_ablation_table() {
  Table table = {
      "ablations",
      "One change at a time",
      "Means over all frames of the movements themselves that the tracker answers (all five; with DB_open_power "
      "Tr3, Tr4 and Tr5); read them beside the share of covered frames. A change is the mean difference, frame by "
      "frame, from the first row of the same ablation and database, over the frames that both answer, with a 95% "
      "interval over blocks of frames; the first row of \"postures\" is what its other databases are compared "
      "with. "
      "Jitter is measured while the hand rests, latency is the posture's.",
      {{"ablation", "ablation"}, {"setting", "setting"}, {"database", "database"}},
      3,
      {}};
  append(table.columns, error_columns());
  table.columns.insert(table.columns.end(), {{"covered_percent", "covered %", 1},
                                             {"jitter_position_mm", "jitter mm"},
                                             {"jitter_rotation_deg", "jitter deg"},
                                             {"latency_frames", "latency frames"}});
  return table;
}

Ablation neighbors_with(const std::string& database) {
  return {"neighbors",
          {{"3", kDefaultSetting, database}, {"1", "1 neighbor", database}, {"15", "15 neighbors", database}}};
}

}  // namespace

std::vector<Setting> ablation_settings(const TrackerConfig& tracker) {
  std::vector<Setting> settings;
  const auto add = [&](const char* name) -> Setting& {
    return settings.emplace_back(Setting{.name = name, .tracker = tracker});
  };
  add(kDefaultSetting);
  add("color-blind").tracker.icp.color_sensitive = false;
  add("no filter").tracker.smoothing.posture_keep = 0;
  add("pose filtered").tracker.smoothing.pose_keep = tracker.smoothing.posture_keep;
  add("culled each").tracker.icp.cull_each_iteration = true;
  add("1 neighbor").tracker.lookup.cascade.back().keep = 1;
  add("15 neighbors").tracker.lookup.cascade.back().keep = 15;
  add("majority").tracker.segmentation.majority_filter = true;
  add("component").tracker.segmentation.largest_component = true;
  add("clutter").clutter_in_volume = true;
  Setting& both = add("clutter, component");
  both.clutter_in_volume = true;
  both.tracker.segmentation.largest_component = true;
  add("subject 2").subject = 2;
  return settings;
}

std::vector<Ablation> ablations() {
  return {
      {"alignment",
       {{"color-sensitive", kDefaultSetting, kAblationDatabase},
        {"color-blind", "color-blind", kAblationDatabase}}},
      {"filter",
       {{"posture", kDefaultSetting, kAblationDatabase},
        {"none", "no filter", kAblationDatabase},
        {"posture and pose", "pose filtered", kAblationDatabase}}},
      {"culling",
       {{"once", kDefaultSetting, kAblationDatabase}, {"in each iteration", "culled each", kAblationDatabase}}},
      neighbors_with(kAblationDatabase),
      neighbors_with("DB_open_power"),
      neighbors_with("DB_20_postures"),
      {"hand region",
       {{"box of all labels", kDefaultSetting, kAblationDatabase},
        {"largest component", "component", kAblationDatabase}}},
      {"hand region, clutter in reach",
       {{"box of all labels", "clutter", kAblationDatabase},
        {"largest component", "clutter, component", kAblationDatabase}}},
      {"labels",
       {{"as they are", kDefaultSetting, kAblationDatabase}, {"3x3 majority", "majority", kAblationDatabase}}},
      {"subject", {{"1", kDefaultSetting, kAblationDatabase}, {"2", "subject 2", kAblationDatabase}}},
  };
}

Runs run_rows(const StudyContext& context, const std::vector<Ablation>& wanted) {
  const std::vector<Setting> known = ablation_settings(context.options.tracker);
  std::map<std::string, std::vector<Setting>> by_database;
  for (const Ablation& ablation : wanted) {
    for (const AblationRow& row : ablation.rows) {
      std::vector<Setting>& settings = by_database[row.database];
      if (std::ranges::find(settings, row.setting, &Setting::name) != settings.end()) continue;
      const auto setting = std::ranges::find(known, row.setting, &Setting::name);
      check(setting != known.end(), "a row names a setting that there is");
      settings.push_back(*setting);
    }
  }
  Runs runs;
  for (auto& [database, settings] : by_database) {
    // Runs of the same images become neighbors, to be rendered once.
    std::ranges::stable_sort(
        settings, {}, [](const Setting& setting) { return std::pair(setting.subject, setting.clutter_in_volume); });
    append(runs, run_study_settings(context, settings, {database}, TruthKind::source, movements_for(database)));
  }
  return runs;
}

Table ablation_table(const Runs& runs, const std::vector<Ablation>& ablations) {
  Table table = empty_ablation_table();
  for (const Ablation& ablation : ablations)
    for (const AblationRow& row : ablation.rows) table.rows.push_back(row_of(runs, ablation, row));
  return table;
}

reports::StudyResult run_ablations(const StudyContext& context) {
  const std::vector<Ablation> changes = ablations();
  std::vector<Ablation> wanted = changes;
  append(wanted, measured_ablations());
  Runs runs = run_rows(context, wanted);

  // One in a quick reproduction: building a database of 20 postures takes most of its time.
  std::vector<PostureSet> choices;
  for (int number = 1; number <= (context.options.quick ? 1 : 3); ++number)
    choices.push_back(random_choice(number));
  append(runs, run_posture_choices(context, choices));

  std::vector<Ablation> shown = changes;
  shown.push_back(posture_choice_ablation(choices));
  reports::StudyResult result{"ablations", "What the paper asserts, one change at a time", {}, {}};
  result.tables = {ablation_table(runs, shown), posture_choice_table(runs, choices), color_table(runs)};
  result.measures = lag_measures(runs);
  append(result.measures, color_measures(runs));
  result.measures.push_back(interpolation_measure(runs));

  for (reports::StudyResult& light : std::array{run_light(context), run_light_curves(context)}) {
    append(result.tables, std::move(light.tables));
    append(result.measures, std::move(light.measures));
  }
  return result;
}

}  // namespace glovebench::eval
