#include "reports/comparison/comparison_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "reports/comparison/gate_rule.h"

namespace glovebench::reports {
namespace {

/// A row of one experiment, with its part in the row over all experiments.
struct ResampledRow {
  ComparisonRow row;
  std::string trajectory;
  Eigen::VectorXd means;  ///< of the resamples; empty below two blocks
};

/// The frames with which the interval would decide if more of them vary as these do, in 2 digits. A difference of
/// the minimum effect or more must be told from zero, a smaller one from the minimum effect. 0: beyond a thousand
/// times the frames.
int frames_that_decide(const ComparisonRow& row, double tail_error) {
  constexpr double kMost = 1000, kSteps = 60;
  const double effect = std::abs(*row.difference);
  const double wanted = effect < row.minimum_effect ? row.minimum_effect - effect : effect;
  const double error = (*row.high - *row.difference) / student_t_above(tail_error, row.blocks - row.trajectories);
  const auto half_width_of = [&](double times) {
    const int freedom = static_cast<int>(times * row.blocks) - row.trajectories;
    return error * student_t_above(tail_error, freedom) / std::sqrt(times);
  };
  if (half_width_of(kMost) >= wanted) return 0;
  double few = 1, enough = kMost;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = (few + enough) / 2;
    (half_width_of(middle) < wanted ? enough : few) = middle;
  }
  const double frames = enough * row.frames;
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(frames)) - 1));
  return static_cast<int>(std::ceil(frames / unit) * unit);
}

void set_interval(ComparisonRow& row, const Eigen::VectorXd& means, double tail_error) {
  const std::optional<double> error = standard_error(means);
  if (!error) return;
  const double half_width = student_t_above(tail_error, row.blocks - row.trajectories) * *error;
  row.low = *row.difference - half_width;
  row.high = *row.difference + half_width;
}

/// Judges the row, whose minimum effect is set.
void judge(ComparisonRow& row, double tail_error) {
  row.verdict = verdict_of(row);
  if (row.verdict == Verdict::not_enough_data && row.high && row.blocks >= kFewestBlocks)
    row.enough_frames = frames_that_decide(row, tail_error);
}

/// Frames that have a pair in any seed.
int frames_with_pairs(const PairedDifferences& differences) {
  int count = 0;
  for (size_t f = 0; !differences.by_seed.empty() && f < differences.by_seed.front().size(); ++f)
    count += std::ranges::any_of(differences.by_seed, [f](const auto& row) { return row[f].has_value(); });
  return count;
}

ResampledRow experiment_row(const Metric& metric, const ExperimentResult& baseline,
                            const ExperimentResult& candidate, const CompareConfig& config, Draws& draws) {
  const PairedDifferences differences = paired_differences(metric, baseline.runs, candidate.runs);
  ResampledRow result = {{}, baseline.key.trajectory, {}};
  ComparisonRow& row = result.row;
  row.experiment = to_string(baseline.key);
  row.metric = &metric;
  row.pairs = differences.pairs;
  row.frames = differences.frames;
  row.baseline = differences.baseline_mean;
  row.candidate = differences.candidate_mean;
  row.difference = differences.mean;
  row.movement_frames = frames_with_pairs(differences);
  row.is_equal = differences.is_equal && differences.pairs > 0;
  const BlockSums sums = block_sums(differences, config.block_frames);
  row.blocks = static_cast<int>(sums.sums.rows());
  if (row.blocks >= 2) result.means = resampled_means(sums, result.trajectory, draws);
  return result;
}

/// The experiments in the row over all: those with an interval, or, if there are none, those with a difference.
std::vector<const ResampledRow*> members_of_all(const std::vector<ResampledRow>& experiments) {
  std::vector<const ResampledRow*> members, with_difference;
  for (const ResampledRow& experiment : experiments) {
    if (experiment.means.size() > 0) members.push_back(&experiment);
    if (experiment.row.difference) with_difference.push_back(&experiment);
  }
  return members.empty() ? with_difference : members;
}

/// Experiments on one trajectory repeat its blocks, so blocks count once per trajectory.
std::map<std::string, int> blocks_by_trajectory(const std::vector<const ResampledRow*>& members) {
  std::map<std::string, int> blocks;
  for (const ResampledRow* member : members) {
    int& fewest = blocks.try_emplace(member->trajectory, member->row.blocks).first->second;
    fewest = std::min(fewest, member->row.blocks);
  }
  return blocks;
}

ComparisonRow all_row(const Metric& metric, const std::vector<ResampledRow>& experiments, double tail_error) {
  ComparisonRow row;
  row.experiment = kAllExperiments;
  row.metric = &metric;
  const std::vector<const ResampledRow*> members = members_of_all(experiments);
  if (members.empty()) {
    for (const ResampledRow& experiment : experiments) row.frames += experiment.row.frames;
    return row;
  }
  const auto count = static_cast<double>(members.size());
  double baseline = 0, candidate = 0, difference = 0;
  Eigen::VectorXd means = Eigen::VectorXd::Zero(members.front()->means.size());
  for (const ResampledRow* member : members) {
    row.pairs += member->row.pairs;
    row.frames += member->row.frames;
    row.movement_frames = std::max(row.movement_frames, member->row.movement_frames);
    baseline += *member->row.baseline;
    candidate += *member->row.candidate;
    difference += *member->row.difference;
    means += member->means;
  }
  row.baseline = baseline / count;
  row.candidate = candidate / count;
  row.difference = difference / count;
  row.is_equal = std::ranges::all_of(experiments, [](const auto& each) { return each.row.is_equal; });
  row.trajectories = 0;
  for (const auto& [trajectory, blocks] : blocks_by_trajectory(members)) {
    row.blocks += blocks;
    ++row.trajectories;
  }
  if (means.size() > 0) set_interval(row, means / count, tail_error);
  return row;
}

void check_config(const CompareConfig& config) {
  check(config.family_error > 0 && config.family_error < 1, "the family error is a probability");
  check(config.block_frames >= 16 && config.resamples >= 100, "a bootstrap has blocks and resamples");
}

}  // namespace

int row_count(size_t metrics, size_t experiments) { return static_cast<int>(metrics * (experiments + 1)); }

std::vector<ComparisonRow> comparison_rows(const Pairing& pairing, const NoiseFloor* floor,
                                           const CompareConfig& config, Draws& draws) {
  check_config(config);
  const size_t experiments = pairing.experiments.size(), metrics = pairing.metrics.size();
  const double tail_error = config.family_error / (2 * row_count(metrics, experiments));
  std::vector<ComparisonRow> rows(row_count(metrics, experiments));
  for (size_t m = 0; m < metrics; ++m) {
    const Metric& metric = *pairing.metrics[m];
    std::vector<ResampledRow> resampled;
    for (const auto& [baseline, candidate] : pairing.experiments)
      resampled.push_back(experiment_row(metric, *baseline, *candidate, config, draws));
    rows[m] = all_row(metric, resampled, tail_error);
    for (size_t e = 0; e < experiments; ++e) {
      auto& [row, trajectory, means] = resampled[e];
      if (means.size() > 0) set_interval(row, means, tail_error);
      rows[(e + 1) * metrics + m] = row;
    }
  }
  int seeds = std::numeric_limits<int>::max();
  for (const auto& [baseline, candidate] : pairing.experiments)
    seeds = std::min(seeds, static_cast<int>(baseline->runs.size()));
  for (ComparisonRow& row : rows) {
    const bool is_all = row.experiment == kAllExperiments;
    // The row over all tolerates two frames per experiment, as an experiment's own row does.
    const int counted = row.metric->is_share() ? row.pairs : row.frames;  // a share is of the frames that have it
    const int frames = is_all ? counted / static_cast<int>(std::max<size_t>(1, experiments)) : counted;
    // If an experiment is missing, the noise floor's row over all does not apply.
    const bool has_entry = floor && !(is_all && !pairing.only_in_baseline.empty());
    row.minimum_effect = minimum_effect(*row.metric, row.experiment, frames, seeds, has_entry ? floor : nullptr);
    row.is_measured = has_entry && floor->find(row.experiment, row.metric->key) != nullptr;
    judge(row, tail_error);
  }
  return rows;
}

}  // namespace glovebench::reports
