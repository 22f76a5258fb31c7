#include "eval/studies/study.h"

#include <fmt/format.h>

#include <numeric>

#include "core/base/error.h"
#include "core/base/text.h"
#include "eval/measured_run.h"
#include "eval/program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using trajectories::Trajectory;

/// The movement and stretch of a quick reproduction; all movements have this stretch.
constexpr const char* kQuickTrajectory = "Tr4";
constexpr FrameRange kQuickFrames = {44, 16};
/// The timed stretch (times_explanation), long enough that over five movements more than one frame lies above the
/// 95th percentile.
constexpr FrameRange kTimedFrames = {44, 24}, kQuickTimedFrames = {44, 2};

RunSpec spec_of(const Setting& setting, const std::string& database) {
  RunSpec spec;
  spec.subject = setting.subject;
  spec.database = database;
  spec.tracker = setting.tracker;
  spec.lighting = setting.lighting;
  spec.clutter_in_volume = setting.clutter_in_volume;
  spec.appearance = setting.appearance;
  spec.setting = setting.name;
  return spec;
}

/// Items of the runs, grouped by trajectory.
template <typename Item>
std::vector<std::vector<Item>> by_trajectory(const Selection& runs,
                                             const std::function<Item(const MeasuredRun&)>& item) {
  std::vector<std::vector<Item>> items;
  const MeasuredRun* before = nullptr;
  for (const MeasuredRun* each : runs) {
    if (!before || before->run.spec.trajectory != each->run.spec.trajectory) items.emplace_back();
    items.back().push_back(item(*each));
    before = each;
  }
  return items;
}

}  // namespace

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"fig7", "Figure 7: tiny images", run_figure7, 100},
      {"fig8", "Figure 8: matching cascades", run_figure8, 300},
      {"fig9", "Figure 9: sub-sampling", run_figure9, 200},
      {"ablations", "What the paper asserts, one change at a time", run_ablations, 300},
      {"monocular", "Without depth", run_monocular, 100},
      {"filter", "Which reading of the filter", run_filter, 20, false, true},
      {"paper-literal", "Figure 4 with the pose filtered, too", run_paper_literal, 360, true, true},
      {"recommended", "Figure 4 with the recommended settings", run_recommended, 500, true, true},
      {"deviations", "Deviations from the paper, and its gaps", run_deviations, 900, true, true},
      {"limits", "What limits profile recommended", run_limits, 1200, true, true},
      {"external", "A program of yours beside ours", run_external, 300, true},
  };
  return all;
}

const Study& study(std::string_view name) {
  std::vector<std::string> known;
  for (const Study& study : studies()) {
    if (study.name == name) return study;
    known.emplace_back(study.name);
  }
  throw Error("study", "name", std::string(name), one_of(known, name));
}

FrameRange frames_of(const StudyOptions& options) { return options.quick ? kQuickFrames : FrameRange{}; }

std::vector<RunSpec> study_specs(const StudyContext& context, const std::vector<Setting>& settings,
                                 const std::vector<std::string>& databases, reports::TruthKind truth,
                                 const std::vector<std::string>& trajectories) {
  std::vector<std::string> names = trajectories.empty() ? trajectories::ground_truth_names() : trajectories;
  if (context.options.quick) names = {kQuickTrajectory};
  const auto load =
      truth == reports::TruthKind::recorded ? trajectories::recorded_trajectory : trajectories::source_trajectory;
  std::vector<RunSpec> specs;
  for (const std::string& name : names) {
    const auto trajectory = std::make_shared<const Trajectory>(load(trajectory_folder(), name));
    for (const uint64_t seed : context.options.seeds) {
      for (const Setting& setting : settings) {
        for (const std::string& database : databases) {
          RunSpec& spec = specs.emplace_back(spec_of(setting, database));
          spec.trajectory = trajectory;
          spec.frames = frames_of(context.options);
          spec.seed = seed;
        }
      }
    }
  }
  return specs;
}

Runs run_specs(const StudyContext& context, std::span<const RunSpec> specs) {
  const RunOptions options = {context.workbench.config().threads, context.store};
  return measure(context.workbench, execute(context.workbench, specs, options));
}

Runs run_study_settings(const StudyContext& context, const std::vector<Setting>& settings,
                        const std::vector<std::string>& databases, reports::TruthKind truth,
                        const std::vector<std::string>& trajectories) {
  return run_specs(context, study_specs(context, settings, databases, truth, trajectories));
}

Runs time_settings(const StudyContext& context, const std::vector<Setting>& settings,
                   const std::vector<std::string>& databases, Implementation implementation,
                   const std::vector<std::string>& trajectories) {
  Runs runs;
  for (const Setting& setting : settings) {
    for (const std::string& database : databases) {
      std::vector<RunSpec> specs =
          study_specs(context, {setting}, {database}, reports::TruthKind::source, trajectories);
      for (RunSpec& spec : specs) {
        spec.frames = context.options.quick ? kQuickTimedFrames : kTimedFrames;
        spec.tracker.lookup.implementation = to_string(implementation);
        spec.tracker.icp.implementation = implementation;
      }
      append(runs, measure(context.workbench, execute(context.workbench, specs, {})));
    }
  }
  return runs;
}

std::string times_explanation() {
  return fmt::format(
      "Times are processor time of one thread of this machine over {} frames of each movement (a quick run: {}), "
      "the paper's of four cores of 2009. Plain are the look-up that goes entry after entry and the closest-point "
      "search that goes face after face, as the paper describes them; fast are those that give the same matches "
      "and points sooner.",
      *kTimedFrames.count, *kQuickTimedFrames.count);
}

Selection select(const Runs& runs, std::string_view setting, std::string_view database) {
  Selection selection;
  for (const MeasuredRun& each : runs)
    if (each.run.spec.setting == setting && each.run.spec.database == database) selection.push_back(&each);
  check(!selection.empty(), "a setting was run before it is asked for");
  return selection;
}

Sample sample_of(const Selection& runs,
                 const std::function<std::optional<double>(const MeasuredRun& run, size_t frame)>& value) {
  return by_trajectory<std::vector<std::optional<double>>>(runs, [&](const MeasuredRun& run) {
    std::vector<std::optional<double>> values;
    for (size_t f = 0; f < run.errors.size(); ++f) values.push_back(value(run, f));
    return values;
  });
}

Sample sample_of(const Selection& runs, std::string_view metric) {
  return sample_of(runs, [&](const MeasuredRun& run, size_t frame) { return run.errors[frame].record[metric]; });
}

std::vector<std::vector<reports::SequenceMetrics>> sequences_of(const Selection& runs) {
  return by_trajectory<reports::SequenceMetrics>(
      runs, [](const MeasuredRun& each) { return measure_sequence(each.run.answers, frames_of(each.run.spec)); });
}

std::vector<double> times_ms(const Selection& runs, std::string_view stage) {
  std::vector<double> times;
  for (const MeasuredRun* each : runs) {
    const Run& run = each->run;
    if (stage.empty()) times.insert(times.end(), run.frame_ms.begin(), run.frame_ms.end());
    for (const reports::StageTiming& timing : run.stages)
      if (timing.stage == stage) times.insert(times.end(), timing.frame_ms.begin(), timing.frame_ms.end());
  }
  return times;
}

std::optional<double> covered_percent(const Selection& runs) {
  return mean(sample_of(runs, [](const MeasuredRun& run, size_t frame) {
    return std::optional(run.errors[frame].record.covered ? 100.0 : 0.0);
  }));
}

std::vector<reports::Cell> cells(const Estimated& estimated) {
  if (!estimated.interval) return {cell(estimated.value), {}, {}};
  return {cell(estimated.value), estimated.interval->low, estimated.interval->high};
}

std::optional<double> tracked_percent(const Selection& runs) {
  return mean(sample_of(runs, [](const MeasuredRun& each, size_t frame) {
    return std::optional(each.run.answers[frame].status == TrackStatus::tracked ? 100.0 : 0.0);
  }));
}

void add_with_interval(std::vector<reports::Column>& columns, const reports::Column& column) {
  columns.push_back(column);
  for (const std::string end : {"low", "high"}) columns.push_back({column.key + "_" + end, end, column.digits});
}

reports::Measure measure_over(int count, const std::string& over, const std::string& name, const std::string& unit,
                              const std::function<std::optional<double>(std::span<const int> drawn)>& statistic) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return {name, unit, statistic(all), interval_over(count, over, statistic)};
}

const std::vector<reports::Column>& error_columns() {
  static const std::vector<reports::Column> columns = {
      {"position_error_mm", "position mm"},   {"position_change_mm", "change"},
      {"position_change_mm_low", "low"},      {"position_change_mm_high", "high"},
      {"posture_error_deg", "posture deg"},   {"posture_change_deg", "change"},
      {"posture_change_deg_low", "low"},      {"posture_change_deg_high", "high"},
      {"rotation_error_deg", "rotation deg"}, {"rotation_change_deg", "change"},
      {"rotation_change_deg_low", "low"},     {"rotation_change_deg_high", "high"}};
  return columns;
}

std::vector<reports::Cell> error_cells(const Selection& runs, const Selection* reference) {
  std::vector<reports::Cell> result;
  for (const char* metric : {"position_error_mm", "posture_rms_deg", "rotation_error_deg"}) {
    const Sample errors = sample_of(runs, metric);
    result.push_back(cell(mean(errors)));
    append(result, cells(reference ? estimate_difference(errors, sample_of(*reference, metric)) : Estimated{}));
  }
  return result;
}

}  // namespace glovebench::eval
