#include "reports/claims/figure4_measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/paper_numbers.h"
#include "reports/tables.h"

namespace glovebench::reports {
namespace {

constexpr std::array<std::string_view, 3> kErrors = {"position_error_mm", "posture_rms_deg", "rotation_error_deg"};
constexpr size_t kTrajectories = 5;

/// A trajectory's experiments: grasp-specific database first, largest last.
using Group = std::array<const ExperimentResult*, 3>;
using Groups = std::array<Group, kTrajectories>;

/// Empty unless all 15 experiments exist.
std::optional<Groups> find_groups(const RunResult& result, TruthKind truth) {
  Groups groups{};
  for (size_t t = 0; t < kTrajectories; ++t) {
    const std::string trajectory = "Tr" + std::to_string(t + 1);
    const std::array<std::string, 3> databases = figure4_databases(trajectory);
    for (size_t d = 0; d < databases.size(); ++d) {
      groups[t][d] = find_experiment(result, {trajectory, databases[d], truth, 1, {}});
      if (!groups[t][d]) return std::nullopt;
    }
  }
  return groups;
}

StratumShape shape_of(const ExperimentResult& experiment) {
  const std::vector<SeedRun>& runs = experiment.runs;
  return {static_cast<int>(runs.size()), runs.empty() ? 0 : static_cast<int>(runs.front().frames.size())};
}

bool can_share_draws(const Group& group) {
  const StratumShape shape = shape_of(*group.front());
  return shape.seeds > 0 && std::ranges::all_of(group, [&](const ExperimentResult* experiment) {
           return shape_of(*experiment).seeds == shape.seeds &&
                  std::ranges::all_of(experiment->runs, [&](const SeedRun& run) {
                    return static_cast<int>(run.frames.size()) == shape.frames;
                  });
         });
}

/// Mean over the drawn frames.
std::optional<double> drawn_mean(const ExperimentResult& experiment, std::string_view metric, const Draw& draw) {
  const size_t value = metric_index(metric);
  double sum = 0;
  int count = 0;
  for (const int seed : draw.seeds) {
    const std::vector<FrameRecord>& frames = experiment.runs[seed].frames;
    for (const int frame : draw.frames) {
      const std::optional<double>& error = frames[frame].values[value];
      if (!error) continue;
      sum += *error;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

/// Means of an error, one per database of a trajectory.
using Means = std::array<std::optional<double>, 3>;
/// Means of an error for one trajectory, over all or over drawn frames.
using MeansOf = std::function<Means(size_t trajectory, std::string_view metric)>;
using Statistic = std::function<std::optional<double>(const MeansOf&)>;

Measure measure(const std::string& name, const std::string& unit, const Groups& groups,
                const Statistic& statistic) {
  Measure measure{name, unit, {}, {}, false};
  measure.value = statistic([&](size_t t, std::string_view metric) -> Means {
    const auto mean_of = [&](int d) { return groups[t][d]->aggregate_of(metric).mean; };
    return {mean_of(0), mean_of(1), mean_of(2)};
  });
  if (!measure.value || !std::ranges::all_of(groups, can_share_draws)) return measure;
  std::vector<StratumShape> strata;
  for (const Group& group : groups) strata.push_back(shape_of(*group.front()));
  measure.interval = stratified_interval(strata, [&](std::span<const Draw> draws) {
    return statistic([&](size_t t, std::string_view metric) -> Means {
      const auto mean_of = [&](int d) { return drawn_mean(*groups[t][d], metric, draws[t]); };
      return {mean_of(0), mean_of(1), mean_of(2)};
    });
  });
  return measure;
}

bool is_number(const std::optional<double>& mean) { return mean && std::isfinite(*mean); }

/// Empty if a mean is missing or not finite, since it could be the largest.
std::optional<double> largest_position_error(const MeansOf& means_of) {
  double largest = 0;
  for (size_t t = 0; t < kTrajectories; ++t) {
    for (const std::optional<double>& mean : means_of(t, "position_error_mm")) {
      if (!is_number(mean)) return std::nullopt;
      largest = std::max(largest, *mean);
    }
  }
  return largest;
}

bool specific_is_best(const Means& means) { return *means[0] < *means[1] && *means[0] < *means[2]; }
bool large_is_worst(const Means& means) { return *means[2] > *means[0] && *means[2] > *means[1]; }
bool is_ordered(const Means& means) { return specific_is_best(means) && large_is_worst(means); }

/// In how many of 15 pairs (trajectory, error) the condition holds; empty if a mean is missing or not finite.
Statistic count_of(bool (*condition)(const Means&)) {
  return [condition](const MeansOf& means_of) -> std::optional<double> {
    int count = 0;
    for (size_t t = 0; t < kTrajectories; ++t)
      for (const std::string_view metric : kErrors) {
        const Means means = means_of(t, metric);
        if (!std::ranges::all_of(means, is_number)) return std::nullopt;
        count += condition(means) ? 1 : 0;
      }
    return count;
  };
}

void add_figure4(std::vector<Measure>& measures, const RunResult& result) {
  const std::string largest = "figure4.largest_mean_position_error_mm_";
  if (const auto groups = find_groups(result, TruthKind::source)) {
    measures.push_back(measure(largest + "source", "mm", *groups, largest_position_error));
    measures.push_back(measure("figure4.ordered_pairs_source", "", *groups, count_of(is_ordered)));
    measures.push_back(measure("figure4.specific_best_source", "", *groups, count_of(specific_is_best)));
    measures.push_back(measure("figure4.large_worst_source", "", *groups, count_of(large_is_worst)));
  }
  if (const auto groups = find_groups(result, TruthKind::recorded))
    measures.push_back(measure(largest + "recorded", "mm", *groups, largest_position_error));
}

void add_curve(std::vector<Measure>& measures, const RunResult& result, const std::string& figure,
               const PaperCurve& curve) {
  const ExperimentResult* experiment =
      find_experiment(result, {curve.trajectory, curve.database, TruthKind::recorded, 1, {}});
  if (!experiment) return;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kNames = {
      {{"position_error_mm", "mm"}, {"posture_error_deg", "deg"}, {"rotation_error_deg", "deg"}}};
  for (size_t e = 0; e < kErrors.size(); ++e) {
    const auto& [name, unit] = kNames[e];
    measures.push_back({figure + "." + std::string(name), std::string(unit),
                        experiment->aggregate_of(kErrors[e]).mean, experiment->interval_of(kErrors[e]), false});
  }
}

}  // namespace

std::vector<Measure> figure4_measures(const RunResult& result) {
  std::vector<Measure> measures;
  add_figure4(measures, result);
  add_curve(measures, result, "figure5", paper_numbers().figure_5);
  add_curve(measures, result, "figure6", paper_numbers().figure_6);
  return measures;
}

}  // namespace glovebench::reports
