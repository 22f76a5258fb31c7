#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// What a metric changed by from the baseline to the candidate: run by run, frame by frame; empty where either
/// has no value.
struct PairedDifferences {
  std::vector<std::vector<std::optional<double>>> by_seed;
  int pairs = 0;
  int frames = 0;  ///< of all seeds
  std::optional<double> baseline_mean;
  std::optional<double> candidate_mean;
  std::optional<double> mean;
};
/// Both have as many runs, of as many frames.
PairedDifferences paired_differences(const Metric& metric, const std::vector<SeedRun>& baseline,
                                     const std::vector<SeedRun>& candidate);

/// Sums and counts of the differences, a row for each block of frames, a column for each seed.
struct BlockSums {
  Eigen::MatrixXd sums;
  Eigen::MatrixXd counts;
};
/// Every block has at least `block_frames` frames (but where there are fewer in all), and about as many as the
/// others. Blocks without a pair are left out: they would count as evidence that nothing varies.
BlockSums block_sums(const PairedDifferences& differences, int block_frames);

/// How often each block and each seed occurs in each resample (rows), one fewer drawn than there are: so the
/// resamples vary as the mean over the blocks does, unbiased even where there are few (Rao and Wu, JASA 1988).
/// Experiments on the same trajectory share their draws, since its difficult moments are difficult in all of them.
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

/// The mean difference of each resample; NaN where it drew no pair.
Eigen::VectorXd resampled_means(const BlockSums& sums, const std::string& trajectory, Draws& draws);
/// Standard deviation of the resamples that have a mean; empty if fewer than half of them do.
std::optional<double> standard_error(const Eigen::VectorXd& means);
/// The value that Student's t exceeds with this probability.
double student_t_above(double probability, int degrees_of_freedom);

}  // namespace glovebench::reports
