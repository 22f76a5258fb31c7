#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// Candidate minus baseline: [run][frame], empty where either has no value.
struct PairedDifferences {
  std::vector<std::vector<std::optional<double>>> by_seed;
  bool is_equal = true;  ///< in all values and gaps
  int pairs = 0;
  int frames = 0;  ///< of all seeds
  std::optional<double> baseline_mean;
  std::optional<double> candidate_mean;
  std::optional<double> mean;
};
/// Both must have equal numbers of runs and frames.
PairedDifferences paired_differences(const Metric& metric, const std::vector<SeedRun>& baseline,
                                     const std::vector<SeedRun>& candidate);

/// Rows are blocks of frames, columns are seeds.
struct BlockSums {
  Eigen::MatrixXd sums;
  Eigen::MatrixXd counts;
};
/// Blocks are about equally long, at least `block_frames` if there are so many. Skips blocks without a pair.
BlockSums block_sums(const PairedDifferences& differences, int block_frames);

/// How often each resample (row) has each block or seed. Draws n - 1 of n, so the variance is unbiased (rescaled
/// bootstrap, Rao and Wu, JASA 1988). Experiments on a trajectory share draws.
class Draws {
 public:
  Draws(uint64_t seed, int resamples) : seed_(seed), resamples_(resamples) {}
  const Eigen::MatrixXd& of_blocks(const std::string& trajectory, int blocks);
  const Eigen::MatrixXd& of_seeds(int seeds);

 private:
  const Eigen::MatrixXd& draw(const std::string& sequence, const std::string& purpose, int count);

  uint64_t seed_;
  int resamples_;
  std::map<std::pair<std::string, int>, Eigen::MatrixXd> drawn_;
};

/// Mean differences per resample. NaN without a pair.
Eigen::VectorXd resampled_means(const BlockSums& sums, const std::string& trajectory, Draws& draws);
/// Standard deviation, without NaN. Empty if over half are NaN.
std::optional<double> standard_error(const Eigen::VectorXd& means);
/// The value that Student's t exceeds with this probability.
double student_t_above(double probability, int degrees_of_freedom);

}  // namespace glovebench::reports
