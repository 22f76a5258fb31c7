#include "reports/statistics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "core/base/random.h"

namespace glovebench::reports {
namespace {

using Values = std::vector<double>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Statistics, EmptyInputHasNoValue) {
  EXPECT_EQ(mean({}), std::nullopt);
  EXPECT_EQ(rms({}), std::nullopt);
  EXPECT_EQ(percentile({}, 0.5), std::nullopt);
  EXPECT_EQ(aggregate({}), Aggregate{});
  EXPECT_EQ(pck_curve({}, 0), PckCurve{});
}

TEST(Statistics, ASingleValueIsEveryStatistic) {
  EXPECT_EQ(aggregate(Values{-3.5}), (Aggregate{1, -3.5, -3.5, 3.5, -3.5, -3.5}));
}

TEST(Statistics, NonFiniteInputIsRefused) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_THROW(mean(Values{1, bad}), std::logic_error);
    EXPECT_THROW(rms(Values{bad, 1}), std::logic_error);
    EXPECT_THROW(percentile(Values{bad}, 0.5), std::logic_error);
    EXPECT_THROW(aggregate(Values{0, bad, 2}), std::logic_error);
    EXPECT_THROW(pck_curve(Values{bad}, 1), std::logic_error);
    EXPECT_THROW(confidence_interval({{1.0, bad, 2.0}}, {.block_frames = 1}), std::logic_error);
  }
}

TEST(Statistics, HandComputedValues) {
  const Values values = {4, 1, 3, 2};
  EXPECT_DOUBLE_EQ(*mean(values), 2.5);
  EXPECT_DOUBLE_EQ(*rms(values), std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(*percentile(values, 0), 1);
  EXPECT_DOUBLE_EQ(*percentile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(*percentile(values, 0.95), 3.85);  // rank 2.85 between 3 and 4
  EXPECT_DOUBLE_EQ(*percentile(values, 1), 4);
}

TEST(Statistics, PckCountsLostKeypointsInTheDenominator) {
  const PckCurve curve = pck_curve(Values{0, 10, 60}, 4);
  ASSERT_EQ(curve.shares.size(), 51u);
  EXPECT_EQ(curve.thresholds_mm.back(), 50);
  EXPECT_DOUBLE_EQ(curve.shares[0], 0.25);
  EXPECT_DOUBLE_EQ(curve.shares[9], 0.25);
  EXPECT_DOUBLE_EQ(curve.shares[10], 0.5);
  EXPECT_DOUBLE_EQ(curve.shares[50], 0.5);
  // 9 mm at 0.25, one trapezoid from 0.25 to 0.5, 40 mm at 0.5.
  EXPECT_DOUBLE_EQ(*curve.area, (9 * 0.25 + 0.375 + 40 * 0.5) / 50);
  EXPECT_THROW(pck_curve(Values{1, 2}, 1), std::logic_error);
}

TEST(Statistics, PerfectKeypointsFillTheCurve) { EXPECT_DOUBLE_EQ(*pck_curve(Values{0, 0}, 2).area, 1); }

std::vector<std::vector<std::optional<double>>> noisy_values(uint64_t stream, int seeds, int frames) {
  std::vector<std::vector<std::optional<double>>> values(seeds);
  RandomStream random(stream, "statistics_test", 0, "noise");
  for (auto& row : values)
    for (int i = 0; i < frames; ++i) row.push_back(5 + random.normal());
  return values;
}

TEST(Statistics, IntervalHoldsTheTrueMeanAboutAsOftenAsItsLevelSays) {
  constexpr int kTrials = 200;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto interval = confidence_interval(noisy_values(trial, 1, 300), {.block_frames = 10, .resamples = 300});
    held += interval->low <= 5 && 5 <= interval->high;
  }
  // Binomial with deviation 0.015 at 0.95; a percentile bootstrap of 30 blocks stays a little below its level.
  EXPECT_GE(held, 0.88 * kTrials);
  EXPECT_LE(held, 0.995 * kTrials);
}

TEST(Statistics, IntervalSaysWhatItIsOver) {
  const auto many = confidence_interval(noisy_values(1, 5, 40));
  ASSERT_TRUE(many);
  EXPECT_EQ(many->seeds, 5);
  EXPECT_EQ(many->blocks, 3);  // 15 + 15 + 10 frames
  EXPECT_EQ(many->over, "noise seeds and blocks of frames of this movement");
  EXPECT_LT(many->low, many->high);
  EXPECT_EQ(many, confidence_interval(noisy_values(1, 5, 40))) << "the same input gives the same interval";
  EXPECT_EQ(confidence_interval(noisy_values(1, 1, 40))->over, "blocks of frames of this movement, one noise seed");
}

TEST(Statistics, NoIntervalOfTooLittle) {
  EXPECT_EQ(confidence_interval({}), std::nullopt);
  EXPECT_EQ(confidence_interval(noisy_values(1, 3, 15)), std::nullopt) << "one block";
  EXPECT_EQ(confidence_interval({{std::nullopt, std::nullopt}}, {.block_frames = 1}), std::nullopt) << "all lost";
}

TEST(Statistics, ConstantValuesHaveAnIntervalOfNoWidth) {
  const auto interval = confidence_interval({{2.0, std::nullopt, 2.0, 2.0}}, {.block_frames = 2});
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->low, 2);
  EXPECT_EQ(interval->high, 2);
}

/// Mean over all drawn values; one table per stratum.
auto mean_of(const std::vector<std::vector<Values>>& strata) {
  return [&strata](std::span<const Draw> draws) -> std::optional<double> {
    Values drawn;
    for (size_t s = 0; s < strata.size(); ++s)
      for (const int seed : draws[s].seeds)
        for (const int frame : draws[s].frames) drawn.push_back(strata[s][seed][frame]);
    return mean(drawn);
  };
}

TEST(Statistics, StrataAreNotMixed) {
  // Two different constant strata: any draw has the same mean.
  const std::vector<std::vector<Values>> strata = {{Values(40, 1.0)}, {Values(20, 7.0)}};
  const auto interval =
      stratified_interval(std::vector<StratumShape>{{1, 40}, {1, 20}}, mean_of(strata), {.block_frames = 10});
  ASSERT_TRUE(interval);
  EXPECT_DOUBLE_EQ(interval->low, 3);
  EXPECT_DOUBLE_EQ(interval->high, 3);
  EXPECT_EQ(interval->blocks, 6);
}

TEST(Statistics, AStratifiedIntervalHoldsTheTrueMeanAboutAsOftenAsItsLevelSays) {
  int held = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    RandomStream random(trial, "test", 0, "values");
    std::vector<std::vector<Values>> strata(2, std::vector<Values>(1));
    for (auto& stratum : strata)
      for (int i = 0; i < 100; ++i) stratum[0].push_back(random.normal());
    const auto interval = stratified_interval(std::vector<StratumShape>(2, {1, 100}), mean_of(strata),
                                              {.block_frames = 4, .resamples = 400});
    held += interval->low <= 0 && 0 <= interval->high;
  }
  // 95% of 200 are 190; a percentile interval over 50 blocks covers a little less, and chance costs up to 11.
  EXPECT_GE(held, 175);
  EXPECT_LE(held, 199);
}

TEST(Statistics, NoStratifiedIntervalOfTooLittle) {
  const auto none = [](std::span<const Draw>) { return std::optional<double>(); };
  const auto one = [](std::span<const Draw>) { return std::optional<double>(1); };
  EXPECT_EQ(stratified_interval({}, one), std::nullopt);
  EXPECT_EQ(stratified_interval(std::vector<StratumShape>{{1, 30}, {1, 44}}, one), std::nullopt) << "2 + 2 blocks";
  EXPECT_EQ(stratified_interval(std::vector<StratumShape>{{1, 60}}, none), std::nullopt);
  EXPECT_TRUE(stratified_interval(std::vector<StratumShape>{{1, 30}, {1, 45}}, one));
}

TEST(Statistics, StudentQuantilesAreThoseOfTheTables) {
  for (const auto& [degrees, quantile] :
       {std::pair{1, 12.706205}, {2, 4.302653}, {4, 2.776445}, {9, 2.262157}, {29, 2.045230}, {1000, 1.962339}})
    EXPECT_NEAR(student_quantile(0.95, degrees), quantile, 1e-6) << degrees;  // as the tables are rounded
  EXPECT_NEAR(student_quantile(0.5, 1), 1, 1e-12) << "half of Cauchy's distribution";
}

TEST(StudentP, IsThatOfTheTables) {
  EXPECT_NEAR(student_p(2.776445, 4), 0.05, 1e-7);
  EXPECT_NEAR(student_p(4.604095, 4), 0.01, 1e-7);
  EXPECT_NEAR(student_p(12.706205, 1), 0.05, 1e-8);
  EXPECT_EQ(student_p(0, 4), 1);
  EXPECT_NEAR(student_p(std::numeric_limits<double>::infinity(), 4), 0, 1e-15);
}

TEST(Holm, WorkedExamples) {
  const auto expect = [](const Values& p_values, const Values& adjusted) {
    const Values found = holm_adjusted(p_values);
    ASSERT_EQ(found.size(), adjusted.size());
    for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], adjusted[i], 1e-12) << i;
  };
  // The example of the textbooks: at 5% the first and the last are significant; 0.03 is not, for 2 x 0.03 > 5%.
  expect({0.01, 0.04, 0.03, 0.005}, {0.03, 0.06, 0.06, 0.02});
  expect({0.02}, {0.02});
  expect({}, {});
  expect({0.5, 0.9}, {1, 1});
  expect({0.01, 0.01, 0.01}, {0.03, 0.03, 0.03});
  expect({0.001, 0.04, 0.021}, {0.003, 0.042, 0.042});
}

TEST(Statistics, AStudentIntervalComputedByHand) {
  // Mean 3, standard deviation sqrt(2.5), so 3 +- 2.776445 * sqrt(2.5 / 5).
  const auto interval = student_interval(Values{1, 2, 3, 4, 5}, "movements");
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 3 - 1.963243, 1e-6);
  EXPECT_NEAR(interval->high, 3 + 1.963243, 1e-6);
  EXPECT_EQ(interval->level, 0.95);
  EXPECT_EQ(interval->over, "movements");
}

TEST(Statistics, NoStudentIntervalOfTooLittle) {
  EXPECT_EQ(student_interval({}, "movements"), std::nullopt);
  EXPECT_EQ(student_interval(Values{1, 2, 3, 4}, "movements"), std::nullopt);
  EXPECT_EQ(student_interval(Values(10, 100.0), "movements"), std::nullopt) << "all found: no spread to judge by";
  EXPECT_TRUE(student_interval(Values{1, 1, 1, 1, 2}, "movements"));
  EXPECT_THROW(student_interval(Values{1, 2, 3, 4, kNaN}, "movements"), std::logic_error);
}

/// The mean error of one movement of 100 frames at 15 Hz: drifts with a time constant of 2 to 20 s, and noise.
double simulated_movement(RandomStream& random) {
  constexpr int frames = 100;
  const double keep = std::exp(-1 / (15 * random.uniform(2, 20)));
  double drift = random.normal(), sum = 0;
  for (int f = 0; f < frames; ++f) {
    sum += drift + 0.5 * random.normal();
    drift = keep * drift + std::sqrt(1 - keep * keep) * random.normal();
  }
  return sum / frames;
}

TEST(StatisticsLong, AStudentIntervalOverMovementsHoldsAsOftenAsItSays) {
  constexpr int draws = 10'000;
  std::map<size_t, int> held = {{5, 0}, {10, 0}, {30, 0}};
  for (int draw = 0; draw < draws; ++draw) {
    RandomStream random(1, "statistics_test", draw, "movements");
    Values movements;
    for (int m = 0; m < 30; ++m) movements.push_back(simulated_movement(random));
    for (auto& [count, times] : held) {
      const auto interval = student_interval(std::span(movements).first(count), "movements");
      times += interval->low <= 0 && 0 <= interval->high;
    }
  }
  // The standard deviation of each share is sqrt(0.95 * 0.05 / 10000) = 0.2%.
  for (const auto& [count, times] : held) EXPECT_NEAR(times, 0.95 * draws, 0.01 * draws) << count << " movements";
}

}  // namespace
}  // namespace glovebench::reports
