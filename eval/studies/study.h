#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/measured_run.h"
#include "eval/studies/sample.h"
#include "reports/study.h"

namespace glovebench::eval {

struct StudyOptions {
  TrackerConfig tracker;
  std::vector<uint64_t> seeds = {1};
  bool quick = false;             ///< for tests
  std::vector<Cascade> cascades;  ///< of Figure 8; empty: the paper's
};

/// `store` keeps finished runs; may be null.
struct StudyContext {
  Workbench& workbench;
  const StudyOptions& options;
  RunStore* store = nullptr;
};

struct Study {
  std::string_view name;  ///< "fig8"
  std::string_view title;
  reports::StudyResult (*run)(const StudyContext& context);
  double cpu_s;               ///< per seed, roughly
  bool on_request = false;    ///< only if named
  bool own_settings = false;  ///< ignores StudyOptions::tracker
};
/// In running order.
const std::vector<Study>& studies();
/// Throws: Error.
const Study& study(std::string_view name);

struct Setting {
  std::string name;
  TrackerConfig tracker;
  int subject = 1;
  render::Lighting lighting = {};
  bool clutter_in_volume = false;
  Appearance appearance = Appearance::glove;
};

/// All frames; with `quick`, a stretch.
FrameRange frames_of(const StudyOptions& options);

/// Each setting with each database on these trajectories (empty: all five; quick: one), with the study's
/// seeds and the paper's noise. Order: trajectory, seed, setting, database.
std::vector<RunSpec> study_specs(const StudyContext& context, const std::vector<Setting>& settings,
                                 const std::vector<std::string>& databases, reports::TruthKind truth,
                                 const std::vector<std::string>& trajectories = {});

using Runs = std::vector<MeasuredRun>;
/// Use errors only: runs share the machine.
Runs run_specs(const StudyContext& context, std::span<const RunSpec> specs);
/// `run_specs` of `study_specs`.
Runs run_study_settings(const StudyContext& context, const std::vector<Setting>& settings,
                        const std::vector<std::string>& databases, reports::TruthKind truth,
                        const std::vector<std::string>& trajectories = {});
/// Runs for times, one at a time, on a stretch of each source truth. Not stored.
Runs time_settings(const StudyContext& context, const std::vector<Setting>& settings,
                   const std::vector<std::string>& databases, Implementation implementation,
                   const std::vector<std::string>& trajectories = {});
std::string times_explanation();

/// Runs by trajectory, then seed.
using Selection = std::vector<const MeasuredRun*>;
/// Requires at least one run. `runs` must outlive the result.
Selection select(const Runs& runs, std::string_view setting, std::string_view database);

Sample sample_of(const Selection& runs,
                 const std::function<std::optional<double>(const MeasuredRun& run, size_t frame)>& value);
Sample sample_of(const Selection& runs, std::string_view metric);
/// [trajectory][seed].
std::vector<std::vector<reports::SequenceMetrics>> sequences_of(const Selection& runs);
/// Times of a stage, or of whole frames, over all frames and runs.
std::vector<double> times_ms(const Selection& runs, std::string_view stage = "");
std::optional<double> covered_percent(const Selection& runs);
std::optional<double> tracked_percent(const Selection& runs);

/// Value, low, high.
std::vector<reports::Cell> cells(const Estimated& estimated);
using reports::cell;
/// The column, then those of its interval: KEY_low and KEY_high.
void add_with_interval(std::vector<reports::Column>& columns, const reports::Column& column);
const std::vector<reports::Column>& error_columns();
/// 12 cells: mean errors of position, posture and rotation, each with its change from `reference` (may be null)
/// and interval.
std::vector<reports::Cell> error_cells(const Selection& runs, const Selection* reference);

/// A statistic of `count` things, with its interval_over them.
reports::Measure measure_over(int count, const std::string& over, const std::string& name, const std::string& unit,
                              const std::function<std::optional<double>(std::span<const int> drawn)>& statistic);

template <typename T>
void append(std::vector<T>& all, std::vector<T> more) {
  std::ranges::move(more, std::back_inserter(all));
}

reports::StudyResult run_figure7(const StudyContext& context);
reports::StudyResult run_figure8(const StudyContext& context);
reports::StudyResult run_figure9(const StudyContext& context);
reports::StudyResult run_ablations(const StudyContext& context);
reports::StudyResult run_monocular(const StudyContext& context);
/// Figures 5 and 6 with profiles paper and paper-literal.
reports::StudyResult run_filter(const StudyContext& context);
reports::StudyResult run_deviations(const StudyContext& context);
/// Figure 4, profiles paper and paper-literal.
reports::StudyResult run_paper_literal(const StudyContext& context);
/// Figure 4, profiles paper and recommended.
reports::StudyResult run_recommended(const StudyContext& context);
/// Suite families, profile recommended, given parts of the truth.
reports::StudyResult run_limits(const StudyContext& context);
/// The program of `options.tracker` beside profiles paper and recommended, gloved and bare.
/// Throws: Error unless the method is a program.
reports::StudyResult run_external(const StudyContext& context);
/// monocular.depth_error_cm: with the first database and the tracker's own hand.
reports::StudyResult measure_monocular(const StudyContext& context, const std::vector<std::string>& databases);
/// Tables "light" and "light_tracking" of the ablations, and measures light.*.
reports::StudyResult run_light(const StudyContext& context);

}  // namespace glovebench::eval
