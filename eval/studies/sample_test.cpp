#include "eval/studies/sample.h"

#include <gtest/gtest.h>

namespace glovebench::eval {
namespace {

/// 40 frames of one movement and one seed, enough blocks for an interval.
Sample constant(double value) { return {{std::vector<std::optional<double>>(90, value)}}; }
Sample ramp() {
  Sample sample = constant(0);
  for (size_t f = 0; f < sample[0][0].size(); ++f) sample[0][0][f] = static_cast<double>(f);
  return sample;
}

const Sample kTwoMovements = {{{1.0, 2.0}, {3.0, std::nullopt}}, {{10.0}, {std::nullopt}}};

TEST(Sample, mean_is_over_all_values_of_all_movements_and_seeds) {
  EXPECT_DOUBLE_EQ(*mean(kTwoMovements), 4.0);  // (1 + 2 + 3 + 10) / 4
  EXPECT_FALSE(mean({}).has_value());
  EXPECT_FALSE(mean({{{std::nullopt}}}).has_value());
  EXPECT_FALSE(estimate_mean({{{std::nullopt}}}).interval.has_value());
}

TEST(Sample, difference_is_over_frames_that_have_both_values) {
  const Sample other = {{{0.5, std::nullopt}, {1.0, 7.0}}, {{4.0}, {9.0}}};
  EXPECT_DOUBLE_EQ(*estimate_difference(kTwoMovements, other).value, 8.5 / 3);  // 0.5, 2, 6
  EXPECT_DOUBLE_EQ(*estimate_difference(other, kTwoMovements).value, -8.5 / 3);
}

TEST(Sample, interval_of_a_constant_difference_has_no_width) {
  Sample shifted = ramp();
  for (auto& value : shifted[0][0]) *value += 2;
  const Estimated difference = estimate_difference(shifted, ramp());
  EXPECT_EQ(difference.value, 2.0);
  ASSERT_TRUE(difference.interval.has_value());
  EXPECT_EQ(difference.interval->low, 2.0);
  EXPECT_EQ(difference.interval->high, 2.0);
  const Estimated plain = estimate_mean(ramp());
  ASSERT_TRUE(plain.interval.has_value());
  EXPECT_LT(plain.interval->low, *plain.value - 1) << "the ramp itself varies from block to block";
  EXPECT_GT(plain.interval->high, *plain.value + 1);
}

TEST(Sample, estimate_draws_the_frames_of_all_samples_together) {
  Sample twice = ramp();
  for (auto& value : twice[0][0]) *value *= 2;
  const Estimated ratio = estimate(
      std::vector{twice, ramp()}, [](std::span<const double> means) { return std::optional(means[0] / means[1]); });
  EXPECT_DOUBLE_EQ(*ratio.value, 2);
  EXPECT_NEAR(ratio.interval->low, 2, 1e-12);
  EXPECT_NEAR(ratio.interval->high, 2, 1e-12);
}

TEST(Sample, samples_of_different_frames_are_not_put_together) {
  EXPECT_THROW(estimate_difference(ramp(), kTwoMovements), std::logic_error);
  EXPECT_THROW(where(ramp(), kTwoMovements), std::logic_error);
}

TEST(Sample, where_keeps_what_is_marked) {
  const Sample keep = {{{1.0, 0.0}, {std::nullopt, 1.0}}, {{5.0}, {1.0}}};
  const Sample expected = {{{1.0, std::nullopt}, {std::nullopt, std::nullopt}}, {{10.0}, {std::nullopt}}};
  EXPECT_EQ(where(kTwoMovements, keep), expected);
}

TEST(IntervalOver, draws_the_things_again) {
  const std::vector<double> values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const auto mean_of = [&](std::span<const int> drawn) {
    double sum = 0;
    for (const int i : drawn) sum += values.at(i);
    return std::optional(sum / static_cast<double>(drawn.size()));
  };
  const auto interval = interval_over(10, "tens", mean_of);
  ASSERT_TRUE(interval.has_value());
  EXPECT_EQ(interval->over, "tens");
  EXPECT_EQ(interval->blocks, 10);
  // The mean of ten draws has a standard deviation of 2.87 / sqrt(10) = 0.91, so 95% lie within 1.78.
  EXPECT_NEAR(interval->low, 5.5 - 1.78, 0.25);
  EXPECT_NEAR(interval->high, 5.5 + 1.78, 0.25);
  EXPECT_FALSE(interval_over(1, "ones", mean_of).has_value());
}

}  // namespace
}  // namespace glovebench::eval
