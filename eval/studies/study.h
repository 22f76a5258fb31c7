#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/measured_run.h"
#include "eval/studies/sample.h"
#include "reports/study.h"

namespace glovebench::eval {

/// What a reproduction is asked for.
struct StudyOptions {
  TrackerConfig tracker;
  std::vector<uint64_t> seeds = {1};
  bool quick = false;             ///< few frames and queries: to see that everything runs, not to measure
  std::vector<Cascade> cascades;  ///< of Figure 8; empty: the paper's four
};

/// What a study works with. It keeps what it has finished in the store, if there is one.
struct StudyContext {
  Workbench& workbench;
  const StudyOptions& options;
  RunStore* store = nullptr;
};

/// A figure of the paper, or a question about it: runs what it needs and returns tables and measures.
struct Study {
  std::string_view name;   ///< on the command line: "fig8"
  std::string_view title;  ///< "Figure 8: matching cascades"
  reports::StudyResult (*run)(const StudyContext& context);
};
/// In the order in which they are run.
const std::vector<Study>& studies();
/// Throws Error listing the known ones.
const Study& study(std::string_view name);

/// One way to run the trajectories of a study.
struct Setting {
  std::string name;
  TrackerConfig tracker;
  int subject = 1;
  render::Lighting lighting = {};
  bool clutter_in_volume = false;
};

/// The frames of each trajectory: all, or in a quick reproduction the stretch that it looks at.
FrameRange frames_of(const StudyOptions& options);

/// Each setting with each database on the trajectories of these names, or on all five if there are none (a quick
/// reproduction: on one), with the noise seeds of the study and gradient noise x 1. What shows the same stands
/// together: by trajectory, seed, setting, database.
std::vector<RunSpec> study_specs(const StudyContext& context, const std::vector<Setting>& settings,
                                 const std::vector<std::string>& databases, reports::TruthKind truth,
                                 const std::vector<std::string>& trajectories = {});

/// The runs of a study; each says its setting.
using Runs = std::vector<MeasuredRun>;
/// Runs `study_specs`. For errors: the runs share the machine, so that their times say little.
Runs run_settings(const StudyContext& context, const std::vector<Setting>& settings,
                  const std::vector<std::string>& databases, reports::TruthKind truth,
                  const std::vector<std::string>& trajectories = {});
/// The same for times, on source truths: with that look-up and closest-point search, on one thread, one tracker at
/// a time, so that none finds its caches emptied by another, over a stretch of each movement (the plain search
/// takes up to a second a frame). The runs are not kept for a program that goes on after an interrupt; the times of
/// a study that was finished are, for this machine.
Runs time_settings(const StudyContext& context, const std::vector<Setting>& settings,
                   const std::vector<std::string>& databases, Implementation implementation,
                   const std::vector<std::string>& trajectories = {});
/// What a table says of times that were measured so.
std::string times_explanation();

/// The runs of one setting with one database: trajectory by trajectory, in each seed by seed.
using Selection = std::vector<const MeasuredRun*>;
/// There must be some. They are those of `runs`, which must outlive them.
Selection select(const Runs& runs, std::string_view setting, std::string_view database);

/// A value of each frame of a run.
Sample sample_of(const Selection& runs,
                 const std::function<std::optional<double>(const MeasuredRun& run, size_t frame)>& value);
/// A metric of each frame, by its key.
Sample sample_of(const Selection& runs, std::string_view metric);
/// Jitter and latency, of each trajectory and noise seed in turn.
std::vector<std::vector<reports::SequenceMetrics>> sequences_of(const Selection& runs);
/// Milliseconds of a stage, or of whole frames if the stage is empty, over all frames of all runs.
std::vector<double> times_ms(const Selection& runs, std::string_view stage = "");
/// The share of frames that are covered, percent.
std::optional<double> covered_percent(const Selection& runs);

/// A value, and the ends of its interval: three cells.
std::vector<reports::Cell> cells(const Estimated& estimated);
using reports::cell;
/// The columns of `error_cells`.
const std::vector<reports::Column>& error_columns();
/// The mean errors of position, posture and rotation, and after each its change against the reference with the ends
/// of the interval: 12 cells. A null reference: no change.
std::vector<reports::Cell> error_cells(const Selection& runs, const Selection* reference);

reports::StudyResult run_figure7(const StudyContext& context);
reports::StudyResult run_figure8(const StudyContext& context);
reports::StudyResult run_figure9(const StudyContext& context);
reports::StudyResult run_ablations(const StudyContext& context);
reports::StudyResult run_monocular(const StudyContext& context);
/// The same with these databases; the measure monocular.depth_error_cm is of the first one and of the hand that the
/// tracker knows.
reports::StudyResult measure_monocular(const StudyContext& context, const std::vector<std::string>& databases);
/// Parts of the ablations: tables "light" and "light_tracking", and the measures light.rgb_excess_percent and
/// light.rgb_excess_own_percent.
reports::StudyResult run_light(const StudyContext& context);

}  // namespace glovebench::eval
