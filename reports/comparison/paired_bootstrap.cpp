#include "reports/comparison/paired_bootstrap.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"

namespace glovebench::reports {

PairedDifferences paired_differences(const Metric& metric, const std::vector<SeedRun>& baseline,
                                     const std::vector<SeedRun>& candidate) {
  check(baseline.size() == candidate.size(), "paired results have as many seeds");
  PairedDifferences differences;
  double baseline_sum = 0, candidate_sum = 0, sum = 0;
  for (size_t s = 0; s < baseline.size(); ++s) {
    check(baseline[s].frames.size() == candidate[s].frames.size(), "paired runs have as many frames");
    differences.frames += static_cast<int>(baseline[s].frames.size());
    auto& row = differences.by_seed.emplace_back();
    for (size_t f = 0; f < baseline[s].frames.size(); ++f) {
      const std::optional<double> before = value_of(metric, baseline[s].frames[f]);
      const std::optional<double> after = value_of(metric, candidate[s].frames[f]);
      row.emplace_back();
      differences.is_equal &= before == after;
      if (!before || !after) continue;
      row.back() = *after - *before;
      ++differences.pairs;
      baseline_sum += *before;
      candidate_sum += *after;
      sum += *row.back();
    }
  }
  if (differences.pairs == 0) return differences;
  differences.baseline_mean = baseline_sum / differences.pairs;
  differences.candidate_mean = candidate_sum / differences.pairs;
  differences.mean = sum / differences.pairs;
  return differences;
}

BlockSums block_sums(const PairedDifferences& differences, int block_frames) {
  const auto seeds = static_cast<int>(differences.by_seed.size());
  const int frames = seeds == 0 ? 0 : static_cast<int>(differences.by_seed.front().size());
  const int blocks = std::min(frames, std::max(1, frames / block_frames));
  BlockSums all = {Eigen::MatrixXd::Zero(blocks, seeds), Eigen::MatrixXd::Zero(blocks, seeds)};
  std::vector<int> with_pairs;
  for (int b = 0; b < blocks; ++b) {
    const int begin = static_cast<int>(int64_t{frames} * b / blocks);
    const int end = static_cast<int>(int64_t{frames} * (b + 1) / blocks);
    for (int s = 0; s < seeds; ++s) {
      const auto& row = differences.by_seed[s];
      check(static_cast<int>(row.size()) == frames, "all seeds replay the same frames");
      for (int f = begin; f < end; ++f) {
        if (!row[f]) continue;
        check(std::isfinite(*row[f]), "a difference is finite");
        all.sums(b, s) += *row[f];
        all.counts(b, s) += 1;
      }
    }
    if (all.counts.row(b).any()) with_pairs.push_back(b);
  }
  return {all.sums(with_pairs, Eigen::all), all.counts(with_pairs, Eigen::all)};
}

const Eigen::MatrixXd& Draws::of_blocks(const std::string& trajectory, int blocks) {
  return draw(trajectory, "blocks", blocks);
}

const Eigen::MatrixXd& Draws::of_seeds(int seeds) { return draw("all trajectories", "seeds", seeds); }

const Eigen::MatrixXd& Draws::draw(const std::string& sequence, const std::string& purpose, int count) {
  Eigen::MatrixXd& drawn = drawn_[{purpose + "/" + sequence, count}];
  if (drawn.size() > 0) return drawn;
  drawn = Eigen::MatrixXd::Zero(resamples_, count);
  const int draws = std::max(1, count - 1);
  for (int r = 0; r < resamples_; ++r) {
    RandomStream random(seed_, sequence, r, purpose);
    for (int d = 0; d < draws; ++d) drawn(r, static_cast<Eigen::Index>(random.index(count))) += 1;
  }
  return drawn;
}

Eigen::VectorXd resampled_means(const BlockSums& sums, const std::string& trajectory, Draws& draws) {
  const Eigen::MatrixXd& blocks = draws.of_blocks(trajectory, static_cast<int>(sums.sums.rows()));
  const Eigen::MatrixXd& seeds = draws.of_seeds(static_cast<int>(sums.sums.cols()));
  const Eigen::VectorXd total = (blocks * sums.sums).cwiseProduct(seeds).rowwise().sum();
  const Eigen::VectorXd count = (blocks * sums.counts).cwiseProduct(seeds).rowwise().sum();
  return total.cwiseQuotient(count);
}

std::optional<double> standard_error(const Eigen::VectorXd& means) {
  double sum = 0;
  int count = 0;
  for (const double mean : means) {
    if (std::isnan(mean)) continue;
    sum += mean;
    ++count;
  }
  if (count < 2 || 2 * count < means.size()) return std::nullopt;
  double squares = 0;
  for (const double mean : means)
    if (!std::isnan(mean)) squares += (mean - sum / count) * (mean - sum / count);
  return std::sqrt(squares / count);
}

double student_t_above(double probability, int degrees_of_freedom) {
  check(probability > 0 && probability < 1 && degrees_of_freedom >= 1, "a quantile of Student's t exists");
  return boost::math::quantile(boost::math::complement(boost::math::students_t(degrees_of_freedom), probability));
}

}  // namespace glovebench::reports
