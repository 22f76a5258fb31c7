#include "eval/studies/settings.h"

#include <fmt/format.h>

#include "eval/sequence_metrics.h"
#include "eval/share.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::TruthKind;
using trajectories::Trajectory;

/// What a quick reproduction looks at, and a stretch that all movements have.
constexpr const char* kQuickTrajectory = "Tr4";
constexpr FrameRange kQuickFrames = {44, 16};
/// What is timed of each movement (times_explanation); so many that a 95th percentile over five of them is
/// one of several frames.
constexpr FrameRange kTimedFrames = {44, 24}, kQuickTimedFrames = {44, 2};

RunSpec spec_of(const Setting& setting, const std::shared_ptr<const Trajectory>& truth, uint64_t seed,
                const std::string& database, const Movements& movements) {
  RunSpec spec;
  spec.trajectory = truth;
  spec.frames = movements.range;
  spec.subject = setting.subject;
  spec.seed = seed;
  spec.database = database;
  spec.tracker = setting.tracker;
  spec.lighting = setting.lighting;
  spec.clutter_in_volume = setting.clutter_in_volume;
  return spec;
}

std::vector<std::vector<Passes>> run_on(const StudyContext& context, const Movements& movements,
                                        const std::vector<Setting>& settings,
                                        const std::vector<std::string>& databases, const RunOptions& options) {
  // Settings stand innermost: what shares its images stands together and is rendered once.
  std::vector<RunSpec> specs;
  for (const auto& truth : movements.truths)
    for (const uint64_t seed : context.options.seeds)
      for (const Setting& setting : settings)
        for (const std::string& database : databases)
          specs.push_back(spec_of(setting, truth, seed, database, movements));
  std::vector<MeasuredRun> runs = measure(context.workbench, execute(context.workbench, specs, options));

  std::vector<std::vector<Passes>> result(settings.size(), std::vector<Passes>(databases.size()));
  size_t next = 0;
  for (size_t t = 0; t < movements.truths.size(); ++t) {
    for (size_t s = 0; s < context.options.seeds.size(); ++s) {
      for (std::vector<Passes>& of_setting : result) {
        for (Passes& passes : of_setting) {
          passes.strata.resize(movements.truths.size());
          passes.strata[t].push_back(std::move(runs[next++]));
        }
      }
    }
  }
  return result;
}

}  // namespace

FrameRange frames_of(const StudyOptions& options) {
  return options.quick ? kQuickFrames : FrameRange{};
}

Movements movements(const StudyContext& context, TruthKind truth, const std::vector<std::string>& names) {
  Movements result;
  std::vector<std::string> wanted = names.empty() ? trajectories::ground_truth_names() : names;
  if (context.options.quick) wanted = {kQuickTrajectory};
  result.range = frames_of(context.options);
  const auto load =
      truth == TruthKind::recorded ? trajectories::recorded_trajectory : trajectories::source_trajectory;
  for (const std::string& name : wanted)
    result.truths.push_back(std::make_shared<const Trajectory>(load(trajectory_folder(), name)));
  return result;
}

std::vector<std::vector<Passes>> run_settings(const StudyContext& context, const Movements& movements,
                                              const std::vector<Setting>& settings,
                                              const std::vector<std::string>& databases) {
  return run_on(context, movements, settings, databases, {context.workbench.config().threads, context.store});
}

std::vector<std::vector<Passes>> time_settings(const StudyContext& context, const Movements& movements,
                                               const std::vector<Setting>& settings,
                                               const std::vector<std::string>& databases,
                                               Implementation implementation) {
  Movements stretches = movements;
  stretches.range = context.options.quick ? kQuickTimedFrames : kTimedFrames;
  std::vector<std::vector<Passes>> result;
  for (Setting setting : settings) {
    setting.tracker.lookup.implementation = implementation;
    setting.tracker.icp.implementation = implementation;
    std::vector<Passes>& of_setting = result.emplace_back();
    for (const std::string& database : databases)
      of_setting.push_back(run_on(context, stretches, {setting}, {database}, {})[0][0]);
  }
  return result;
}

std::string times_explanation() {
  return fmt::format(
      "Times are processor time of one thread of this machine over {} frames of each movement (a quick run: {}), "
      "the paper's of four cores of 2009. Plain are the look-up that goes entry after entry and the closest-point "
      "search that goes face after face, as the paper describes them; fast are those that give the same matches "
      "and points sooner.",
      *kTimedFrames.count, *kQuickTimedFrames.count);
}

Sample sample_of(
    const Passes& passes,
    const std::function<std::optional<double>(const TrackResult&, const reports::FrameErrors&)>& value) {
  Sample sample;
  for (const std::vector<MeasuredRun>& seeds : passes.strata) {
    auto& stratum = sample.emplace_back();
    for (const MeasuredRun& pass : seeds) {
      auto& frames = stratum.emplace_back();
      for (size_t f = 0; f < pass.errors.size(); ++f) frames.push_back(value(pass.run.answers[f], pass.errors[f]));
    }
  }
  return sample;
}

Sample sample_of(const Passes& passes, std::string_view metric) {
  return sample_of(passes,
                   [&](const TrackResult&, const reports::FrameErrors& errors) { return errors.record[metric]; });
}

std::vector<std::vector<reports::SequenceMetrics>> sequences_of(const Passes& passes) {
  std::vector<std::vector<reports::SequenceMetrics>> sequences;
  for (const std::vector<MeasuredRun>& seeds : passes.strata) {
    auto& stratum = sequences.emplace_back();
    for (const MeasuredRun& pass : seeds)
      stratum.push_back(measure_sequence(pass.run.answers, frames_of(pass.run.spec)));
  }
  return sequences;
}

std::vector<double> times_ms(const Passes& passes, std::string_view stage) {
  std::vector<double> times;
  for (const std::vector<MeasuredRun>& seeds : passes.strata) {
    for (const MeasuredRun& pass : seeds) {
      if (stage.empty()) times.insert(times.end(), pass.run.frame_ms.begin(), pass.run.frame_ms.end());
      for (const reports::StageTiming& timing : pass.run.stages)
        if (timing.stage == stage) times.insert(times.end(), timing.frame_ms.begin(), timing.frame_ms.end());
    }
  }
  return times;
}

std::optional<double> covered_percent(const Passes& passes) {
  return mean(sample_of(passes, [](const TrackResult&, const reports::FrameErrors& errors) {
    return std::optional(errors.record.covered ? 100.0 : 0.0);
  }));
}

std::vector<reports::Cell> cells(const Estimated& estimated) {
  if (!estimated.interval) return {cell(estimated.value), {}, {}};
  return {cell(estimated.value), estimated.interval->low, estimated.interval->high};
}

}  // namespace glovebench::eval
