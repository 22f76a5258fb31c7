#pragma once

#include <functional>
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
  bool quick = false;             ///< a test, not a measurement
  std::vector<Cascade> cascades;  ///< of Figure 8; empty: the paper's
};

/// `store` keeps finished runs. May be null.
struct StudyContext {
  Workbench& workbench;
  const StudyOptions& options;
  RunStore* store = nullptr;
};

struct Study {
  std::string_view name;   ///< "fig8"
  std::string_view title;  ///< "Figure 8: matching cascades"
  reports::StudyResult (*run)(const StudyContext& context);
  double cpu_s;             ///< of one seed, roughly
  bool on_request = false;  ///< only if named
};
/// In running order.
const std::vector<Study>& studies();
/// Throws: Error for an unknown name.
const Study& study(std::string_view name);

struct Setting {
  std::string name;
  TrackerConfig tracker;
  int subject = 1;
  render::Lighting lighting = {};
  bool clutter_in_volume = false;
};

/// All frames, or a stretch in a quick reproduction.
FrameRange frames_of(const StudyOptions& options);

/// Each setting with each database on these trajectories (empty: all five; quick: one), with the study's seeds and
/// gradient noise x 1. Order: trajectory, seed, setting, database.
std::vector<RunSpec> study_specs(const StudyContext& context, const std::vector<Setting>& settings,
                                 const std::vector<std::string>& databases, reports::TruthKind truth,
                                 const std::vector<std::string>& trajectories = {});

using Runs = std::vector<MeasuredRun>;
/// Runs `study_specs` for errors. Their times mean little, because runs share the machine.
Runs run_settings(const StudyContext& context, const std::vector<Setting>& settings,
                  const std::vector<std::string>& databases, reports::TruthKind truth,
                  const std::vector<std::string>& trajectories = {});
/// Runs for times, on source truths: one tracker at a time, a stretch of each movement. Not stored.
Runs time_settings(const StudyContext& context, const std::vector<Setting>& settings,
                   const std::vector<std::string>& databases, Implementation implementation,
                   const std::vector<std::string>& trajectories = {});
std::string times_explanation();

/// Runs by trajectory, then seed.
using Selection = std::vector<const MeasuredRun*>;
/// At least one run. `runs` must outlive the result.
Selection select(const Runs& runs, std::string_view setting, std::string_view database);

Sample sample_of(const Selection& runs,
                 const std::function<std::optional<double>(const MeasuredRun& run, size_t frame)>& value);
Sample sample_of(const Selection& runs, std::string_view metric);
/// [trajectory][seed].
std::vector<std::vector<reports::SequenceMetrics>> sequences_of(const Selection& runs);
/// Times of a stage (empty: of whole frames), all frames and runs.
std::vector<double> times_ms(const Selection& runs, std::string_view stage = "");
std::optional<double> covered_percent(const Selection& runs);

/// Value, low, high.
std::vector<reports::Cell> cells(const Estimated& estimated);
using reports::cell;
const std::vector<reports::Column>& error_columns();
/// 12 cells: mean errors of position, posture and rotation, each with its change from `reference` and the interval.
/// Null: no change.
std::vector<reports::Cell> error_cells(const Selection& runs, const Selection* reference);

reports::StudyResult run_figure7(const StudyContext& context);
reports::StudyResult run_figure8(const StudyContext& context);
reports::StudyResult run_figure9(const StudyContext& context);
reports::StudyResult run_ablations(const StudyContext& context);
reports::StudyResult run_monocular(const StudyContext& context);
/// Figures 5 and 6 with profiles paper and paper-literal, beside what the printed curves say of the filter.
reports::StudyResult run_filter(const StudyContext& context);
/// What each deviation from the paper changes. Has no measures.
reports::StudyResult run_deviations(const StudyContext& context);
/// Figure 4 with profiles paper and paper-literal side by side. Has no measures, so it decides no claim.
reports::StudyResult run_paper_literal(const StudyContext& context);
/// monocular.depth_error_cm is of the first database and the tracker's own hand.
reports::StudyResult measure_monocular(const StudyContext& context, const std::vector<std::string>& databases);
/// Tables "light" and "light_tracking" of the ablations, and measures light.*.
reports::StudyResult run_light(const StudyContext& context);

}  // namespace glovebench::eval
