#include "eval/settings_run.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/base/file_set.h"
#include "eval/program.h"
#include "eval/regression/baseline.h"
#include "reports/comparison/comparison_report.h"
#include "reports/summary.h"

namespace glovebench::eval {
namespace {

/// Each spec with each tracker. Those of one spec are neighbors, since they share its images.
std::vector<RunSpec> in_turn(std::span<const RunSpec> specs, std::span<const TrackerConfig> trackers) {
  std::vector<RunSpec> all;
  for (const RunSpec& spec : specs) {
    for (const TrackerConfig& tracker : trackers) {
      all.push_back(spec);
      all.back().tracker = tracker;
    }
  }
  return all;
}

/// The first seed of each experiment, shortened so that all of them together take seconds.
std::vector<RunSpec> timed_specs(const Plan& plan) {
  constexpr int kMostFrames = 600, kFewest = 4, kMostOfOne = 60;
  std::vector<RunSpec> timed;
  for (const RunSpec& spec : plan.specs)
    if (std::ranges::find(timed, key_of(spec), key_of) == timed.end()) timed.push_back(spec);
  const int share = std::clamp(kMostFrames / static_cast<int>(timed.size()), kFewest, kMostOfOne);
  for (RunSpec& spec : timed) spec.frames.count = std::min(share, static_cast<int>(frames_of(spec).size()));
  return timed;
}

void take_times(std::vector<MeasuredRun>& runs, std::span<Run> timed) {
  for (MeasuredRun& each : runs) each.run.stages.clear();
  for (Run& times : timed) {
    const auto run = std::ranges::find_if(runs, [&](const MeasuredRun& each) {
      return key_of(each.run.spec) == key_of(times.spec) && each.run.spec.seed == times.spec.seed;
    });
    run->run.stages = std::move(times.stages);
  }
}

/// Of every `count`-th run from `first` on.
std::vector<Run> every(std::vector<Run>& runs, size_t first, size_t count) {
  std::vector<Run> chosen;
  for (size_t r = first; r < runs.size(); r += count) chosen.push_back(std::move(runs[r]));
  return chosen;
}

/// Empty unless the run was measured one job at a time.
std::optional<double> frame_ms(const reports::StageTimes& times) {
  if (times.threads != 1 || times.stages.empty()) return std::nullopt;
  double ms = 0;
  for (const reports::StageTimes::Stage& stage : times.stages) ms += stage.median_ms;
  return ms;
}

/// The last part of a path that may end with a slash.
std::string folder_name(const std::string& path) {
  const std::filesystem::path absolute = std::filesystem::absolute(path).lexically_normal();
  return (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
}

}  // namespace

Plan with_tracker(Plan plan, const TrackerConfig& tracker) {
  plan.tracker = tracker;
  for (RunSpec& spec : plan.specs) spec.tracker = tracker;
  return plan;
}

std::vector<std::vector<MeasuredRun>> run_settings(Workbench& workbench, const Plan& plan,
                                                   std::span<const TrackerConfig> trackers,
                                                   const RunOptions& options) {
  std::vector<Run> runs =
      execute(workbench, in_turn(plan.specs, trackers), plan.times_frames() ? RunOptions{} : options);
  std::vector<Run> timed = execute(workbench, in_turn(timed_specs(plan), trackers), {});
  std::vector<std::vector<MeasuredRun>> by_tracker;
  for (size_t t = 0; t < trackers.size(); ++t) {
    by_tracker.push_back(measure(workbench, every(runs, t, trackers.size())));
    std::vector<Run> times = every(timed, t, trackers.size());
    take_times(by_tracker.back(), times);
  }
  return by_tracker;
}

reports::SettingsTable settings_table(const std::vector<std::string>& folders, reports::PairingOptions pairing,
                                      const reports::CompareConfig& config) {
  if (pairing.metrics.empty()) pairing.metrics = reports::headline_metrics();
  pairing.across.push_back(reports::Across::hand);
  std::vector<reports::SettingRun> runs;
  std::set<std::string> processors;
  for (const std::string& folder : folders) {
    FinishedRun run = load_finished_run(folder);
    const reports::StageTimes times = load_stage_times(run.files);
    processors.insert(times.processor);
    run.results.name = folder_name(run.files.folder());
    runs.push_back({std::move(run.results), frame_ms(times)});
  }
  if (processors.size() > 1)  // times of different machines say nothing of the settings
    for (reports::SettingRun& run : runs) run.time_ms.reset();
  return reports::compare_settings(runs, pairing, config);
}

void write_settings_table(const std::string& folder, const reports::SettingsTable& table,
                          const std::vector<reports::StudyResult>& studies) {
  reports::require_own_folder(folder, {"table.md", "index.html"});
  WholeFiles files(folder);
  files.add("table.md", settings_markdown(table));
  files.add("table.csv", settings_csv(table));
  files.add("table.tex", settings_latex(table));
  files.add("index.html", settings_html(table, page_scripts()));
  for (const reports::StudyResult& study : studies) {
    files.add(study.name + ".md", study_markdown(study));
    for (const reports::Table& each : study.tables) files.add(each.name + ".csv", to_csv(each));
  }
  files.commit();
}

}  // namespace glovebench::eval
