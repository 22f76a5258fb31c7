#include "eval/settings_run.h"

#include <algorithm>

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

}  // namespace glovebench::eval
