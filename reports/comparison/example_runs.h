#pragma once

#include <functional>

#include "reports/comparison/pairing.h"
#include "reports/example_result.h"

namespace glovebench::reports {

using MakeFrame = std::function<FrameRecord(uint64_t seed, int frame)>;

inline ExperimentResult example_experiment(const std::string& trajectory, const std::vector<uint64_t>& seeds,
                                           int frames, const MakeFrame& make_frame) {
  ExperimentResult experiment;
  experiment.key = {trajectory, "DB_open_power", TruthKind::source, 1, {}};
  for (const uint64_t seed : seeds) {
    SeedRun& run = experiment.runs.emplace_back();
    run.seed = seed;
    for (int f = 0; f < frames; ++f) run.frames.push_back(make_frame(seed, f));
  }
  experiment.coverage = count_coverage(experiment.runs);
  return experiment;
}

inline NamedResult example_named(const std::string& name, std::vector<ExperimentResult> experiments) {
  NamedResult named = {name, small_result()};
  named.result.experiments = std::move(experiments);
  named.result.inputs.databases = {{"DB_open_power", "0a"}};
  named.result.inputs.truths.clear();
  for (const ExperimentResult& experiment : named.result.experiments)
    named.result.inputs.truths[truth_name(experiment.key)] = "ff";
  return named;
}

/// Errors of about 3 mm + `shift_mm`. They depend on movement, seed and `purpose`.
inline ExperimentResult noisy_experiment(const std::string& trajectory, const std::vector<uint64_t>& seeds,
                                         int frames, const std::string& purpose, double shift_mm) {
  std::vector<double> movement(frames, 0);
  RandomStream shared(1, trajectory, 0, "movement");
  for (int f = 1; f < frames; ++f) movement[f] = 0.9 * movement[f - 1] + 0.2 * shared.normal();
  ExperimentResult experiment;
  for (const uint64_t seed : seeds) {
    RandomStream random(seed, trajectory, 0, purpose);
    double slow = 0;
    const auto make_frame = [&](uint64_t, int f) {
      slow = 0.75 * slow + 0.1 * random.normal();
      return example_frame(f, 3 + shift_mm + movement[f] + slow + 0.05 * random.normal(), 5, 3);
    };
    ExperimentResult one = example_experiment(trajectory, {seed}, frames, make_frame);
    experiment.key = one.key;
    experiment.runs.push_back(std::move(one.runs.front()));
  }
  experiment.coverage = count_coverage(experiment.runs);
  return experiment;
}

}  // namespace glovebench::reports
