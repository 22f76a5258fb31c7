#include "eval/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "eval/program.h"
#include "reports/text.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

struct PlannedExperiment {
  std::string name;
  size_t frames = 0;  ///< of one seed
  int seeds = 0;
};

std::vector<PlannedExperiment> planned_experiments(const Plan& plan) {
  std::vector<PlannedExperiment> experiments;
  for (const RunSpec& spec : plan.specs) {
    const std::string name = to_string(key_of(spec));
    auto it = std::ranges::find(experiments, name, &PlannedExperiment::name);
    if (it == experiments.end()) it = experiments.insert(it, {name, frames_of(spec).size(), 0});
    ++it->seeds;
  }
  return experiments;
}

}  // namespace

Plan plan_figure4(const TrackerConfig& tracker, const Figure4Options& options) {
  const std::string folder = trajectory_folder();
  Plan plan{tracker, {}};
  const auto& names = options.trajectories.empty() ? trajectories::ground_truth_names() : options.trajectories;
  for (const reports::NoiseSetting& noise : options.noises) {
    for (const std::string& name : names) {
      const std::vector<std::string> databases = trajectories::databases_of(name);
      const auto recorded =
          std::make_shared<const trajectories::Trajectory>(trajectories::recorded_trajectory(folder, name));
      const auto source =
          std::make_shared<const trajectories::Trajectory>(trajectories::source_trajectory(folder, name));
      const auto add = [&](const std::shared_ptr<const trajectories::Trajectory>& truth, int subject,
                           uint64_t seed) {
        for (const std::string& database : databases)
          plan.specs.push_back({truth, options.frames, subject, noise, seed, database, tracker});
      };
      for (const uint64_t seed : options.seeds) add(recorded, 1, seed);
      for (const uint64_t seed : options.seeds) add(source, 1, seed);
      for (const uint64_t seed : options.seeds) add(source, 2, seed);
    }
  }
  return plan;
}

std::string list_experiments(const Plan& plan) {
  const std::vector<PlannedExperiment> experiments = planned_experiments(plan);
  const size_t width = std::ranges::max(experiments, {}, [](const auto& e) { return e.name.size(); }).name.size();
  std::string text;
  for (const PlannedExperiment& experiment : experiments) {
    text += fmt::format("{:<{}}  {:>4} frames x {}\n", experiment.name, width, experiment.frames,
                        reports::counted(static_cast<size_t>(experiment.seeds), "seed"));
  }
  return text;
}

std::string describe_plan(Workbench& workbench, const Plan& plan) {
  std::set<uint64_t> seeds;
  std::set<std::string> databases;
  size_t frames = 0;
  for (const RunSpec& spec : plan.specs) {
    seeds.insert(spec.seed);
    databases.insert(spec.database);
    frames += frames_of(spec).size();
  }
  std::string text = list_experiments(plan);
  text += fmt::format("seeds {}: {} frames to track\n", fmt::join(seeds, ", "), frames);
  for (const std::string& name : databases)
    text += fmt::format("database {}: {}\n", name, workbench.has_database(name) ? "there" : "to be built");
  return text;
}

}  // namespace glovebench::eval
