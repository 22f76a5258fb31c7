#include "reports/comparison/paired_bootstrap.h"

#include <gmock/gmock.h>

#include <limits>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

/// One value per block of 16 frames; one row per seed.
PairedDifferences blockwise(const std::vector<std::vector<double>>& blocks_by_seed) {
  PairedDifferences differences;
  for (const auto& blocks : blocks_by_seed) {
    auto& row = differences.by_seed.emplace_back();
    for (const double value : blocks) row.insert(row.end(), 16, value);
  }
  return differences;
}

double resampled_error(const PairedDifferences& differences, int resamples) {
  Draws draws(1, resamples);
  return *standard_error(resampled_means(block_sums(differences, 16), "Tr1", draws));
}

TEST(PairedDifferences, AreTakenWhereBothHaveAValue) {
  const SeedRun before = {1, {example_frame(0, 3, 1, 1), example_frame(1, 4, 1, 1), example_lost_frame(2)}};
  const SeedRun after = {1, {example_frame(0, 3.5, 1, 1), example_lost_frame(1), example_lost_frame(2)}};
  const Metric& metric = metric_of("position_error_mm");
  const PairedDifferences position = paired_differences(metric, {before}, {after});
  EXPECT_THAT(position.by_seed, testing::ElementsAre(testing::ElementsAre(0.5, std::nullopt, std::nullopt)));
  EXPECT_EQ(position.pairs, 1);
  EXPECT_EQ(position.frames, 3);
  EXPECT_EQ(position.baseline_mean, 3) << "not of the frame that the candidate lost";
  EXPECT_EQ(position.candidate_mean, 3.5);
  const PairedDifferences uncovered = paired_differences(metric_of("uncovered_percent"), {before}, {after});
  EXPECT_EQ(uncovered.pairs, 3);
  EXPECT_DOUBLE_EQ(*uncovered.mean, 100.0 / 3);
  EXPECT_EQ(paired_differences(metric, {}, {}).mean, std::nullopt);
}

TEST(PairedBootstrap, BlocksAreOfEqualLengthAndHaveAPair) {
  PairedDifferences differences;
  differences.by_seed.assign(1, std::vector<std::optional<double>>(55, 2.0));
  EXPECT_THAT(block_sums(differences, 16).counts.reshaped(), testing::ElementsAre(18, 18, 19));
  EXPECT_THAT(block_sums(differences, 16).sums.reshaped(), testing::ElementsAre(36, 36, 38));
  for (int f = 10; f < 40; ++f) differences.by_seed[0][f].reset();
  EXPECT_THAT(block_sums(differences, 16).counts.reshaped(), testing::ElementsAre(10, 15)) << "the middle is lost";
  differences.by_seed[0].resize(15);
  EXPECT_EQ(block_sums(differences, 16).sums.rows(), 1);
  differences.by_seed[0].clear();
  EXPECT_EQ(block_sums(differences, 16).sums.rows(), 0);
  EXPECT_EQ(block_sums({}, 16).sums.size(), 0);
}

TEST(PairedBootstrap, VarianceIsThatOfAMeanOverBlocks) {
  // s^2 / n with s^2 over n - 1, not n: the usual bootstrap would be 20% short. 40,000 resamples: 0.4% sd.
  EXPECT_NEAR(resampled_error(blockwise({{1, 2, 4, 8, 5}}), 40000), std::sqrt(7.5 / 5), 0.015 * std::sqrt(7.5 / 5));
  EXPECT_NEAR(resampled_error(blockwise({{1, 3}}), 40000), 1, 0.015);
}

TEST(PairedBootstrap, SeedsVaryToo) {
  EXPECT_NEAR(resampled_error(blockwise({{1, 1, 1}, {3, 3, 3}}), 40000), 1, 0.015);
  EXPECT_NEAR(resampled_error(blockwise({{1, 1, 1}, {1, 1, 1}}), 400), 0, 1e-12);
}

TEST(PairedBootstrap, OneTrajectoryHasOneSetOfDraws) {
  Draws draws(7, 200);
  const Eigen::MatrixXd first = draws.of_blocks("Tr1", 6);
  EXPECT_EQ(first, draws.of_blocks("Tr1", 6));
  EXPECT_EQ(first, Draws(7, 200).of_blocks("Tr1", 6)) << "whatever else was drawn before";
  EXPECT_NE(first, draws.of_blocks("Tr2", 6));
  EXPECT_NE(first, Draws(8, 200).of_blocks("Tr1", 6));
  EXPECT_EQ(first.rowwise().sum(), Eigen::VectorXd::Constant(200, 5)) << "one fewer than there are";
  EXPECT_EQ(draws.of_seeds(1), Eigen::MatrixXd::Ones(200, 1));
}

TEST(PairedBootstrap, AResampleWithoutPairsHasNoMean) {
  // Each seed has one block, so a draw of one seed and one block misses it half of the time.
  PairedDifferences differences = blockwise({{1, 1}, {2, 2}});
  for (int f = 0; f < 16; ++f) differences.by_seed[0][f].reset();
  for (int f = 16; f < 32; ++f) differences.by_seed[1][f].reset();
  Draws draws(1, 1000);
  const Eigen::VectorXd means = resampled_means(block_sums(differences, 16), "Tr1", draws);
  EXPECT_NEAR(means.array().isNaN().count(), 500, 60);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(*standard_error(Eigen::Vector4d(1, kNone, 3, kNone)), 1);
  EXPECT_EQ(standard_error(Eigen::Vector4d(1, kNone, kNone, kNone)), std::nullopt);
  EXPECT_EQ(standard_error({}), std::nullopt);
}

TEST(PairedBootstrap, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(student_t_above(0.025, 1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t_above(0.025, 10), 2.2281, 1e-4);
  EXPECT_NEAR(student_t_above(0.0005, 7), 5.4079, 1e-4);
}

}  // namespace
}  // namespace glovebench::reports
