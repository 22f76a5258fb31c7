#include "reports/comparison/comparison.h"

#include <gmock/gmock.h>

#include <numbers>

#include "reports/comparison/comparison_rows.h"
#include "reports/comparison/comparison_text.h"
#include "reports/comparison/example_runs.h"
#include "reports/comparison/gate_rule.h"

namespace glovebench::reports {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<uint64_t> kSeeds = {1, 2};
constexpr std::string_view kPosition = "position_error_mm", kRotation = "rotation_error_deg",
                           kUncovered = "uncovered_percent";

size_t place_of(std::string_view gated_metric) {
  const auto found = std::ranges::find(gated_metrics(), gated_metric, &Metric::key);
  return static_cast<size_t>(found - gated_metrics().begin());
}

/// A row of experiment `e`; -1 is all of them.
const ComparisonRow& row_of(const Comparison& comparison, int e, std::string_view metric) {
  return comparison.rows.at((e + 1) * gated_metrics().size() + place_of(metric));
}

NamedResult noisy(const std::string& purpose, double shift_mm, int frames = 128) {
  std::vector<ExperimentResult> experiments;
  for (const char* trajectory : {"Tr1", "Tr4", "Tr5"})
    experiments.push_back(noisy_experiment(trajectory, kSeeds, frames, purpose, shift_mm));
  return example_named(purpose, std::move(experiments));
}

/// One experiment with one seed and these position errors.
NamedResult of_positions(const std::vector<std::optional<double>>& positions_mm) {
  const MakeFrame make_frame = [&](uint64_t, int f) {
    return positions_mm[f] ? example_frame(f, *positions_mm[f], 5, 2) : example_lost_frame(f);
  };
  return example_named("named",
                       {example_experiment("Tr4", {1}, static_cast<int>(positions_mm.size()), make_frame)});
}

std::vector<std::optional<double>> positions(std::initializer_list<double> blocks) {
  std::vector<std::optional<double>> values;
  for (const double value : blocks) values.insert(values.end(), 16, value);
  return values;
}

TEST(Comparison, EqualResultsAreTheSame) {
  const Comparison comparison =
      compare_results(NamedResult{"a", full_result()}, NamedResult{"a", full_result()}, nullptr);
  EXPECT_EQ(comparison.rows.size(), 46 * gated_metrics().size());
  for (const ComparisonRow& row : comparison.rows) {
    EXPECT_EQ(row.difference, 0) << row.experiment;
    EXPECT_EQ(row.low, 0);
    EXPECT_EQ(row.high, 0);
    EXPECT_EQ(row.verdict, Verdict::same);
  }
  EXPECT_THAT(comparison.worst, IsEmpty());
  EXPECT_FALSE(comparison.other_seeds);
  EXPECT_EQ(comparison.seeds, 2);
}

TEST(Comparison, HandComputed) {
  const Comparison comparison =
      compare_results(of_positions(positions({2, 2})), of_positions(positions({3, 5})), nullptr);
  for (const int e : {-1, 0}) {
    const ComparisonRow& row = row_of(comparison, e, kPosition);
    EXPECT_EQ(row.pairs, 32);
    EXPECT_EQ(row.frames, 32);
    EXPECT_EQ(row.blocks, 2);
    EXPECT_DOUBLE_EQ(*row.baseline, 2);
    EXPECT_DOUBLE_EQ(*row.candidate, 4);
    EXPECT_DOUBLE_EQ(*row.difference, 2);
    // One block of two is drawn, so a mean is 1 or 3: standard error 1. Student's t of one degree of freedom is a
    // Cauchy distribution, 1 / tan(pi p) above p = 0.01 / (2 * 22 rows).
    const double half_width = 1 / std::tan(std::numbers::pi * 0.01 / 44);
    EXPECT_NEAR(*row.high, 2 + half_width, 0.001 * half_width);
    EXPECT_NEAR(*row.low, 2 - half_width, 0.001 * half_width);
    EXPECT_EQ(row.verdict, Verdict::not_enough_data);
  }
  EXPECT_EQ(row_of(comparison, -1, kPosition).experiment, kAllExperiments);
  EXPECT_EQ(row_of(comparison, 0, kPosition).experiment, "Tr4_DB_open_power_source_subject1_gradient_1");
}

TEST(Comparison, AShiftIsFoundAndItsReverseIsBetter) {
  const NamedResult before = noisy("a", 0), after = noisy("a", 0.5);
  const Comparison comparison = compare_results(before, after, nullptr);
  for (int e = -1; e < 3; ++e) {
    EXPECT_EQ(row_of(comparison, e, kPosition).verdict, Verdict::worse) << "an equal amount in every frame";
    EXPECT_NEAR(*row_of(comparison, e, kPosition).difference, 0.5, 1e-9);
    EXPECT_EQ(row_of(comparison, e, kRotation).verdict, Verdict::same) << "the rotation did not change";
  }
  const Comparison reverse = compare_results(after, before, nullptr);
  for (int e = -1; e < 3; ++e) EXPECT_EQ(row_of(reverse, e, kPosition).verdict, Verdict::better);
}

TEST(Comparison, ARealChangeIsFoundUnderOtherNoise) {
  // 1 mm against a standard error of about 0.05 mm, and a t of about 12 at 7 degrees of freedom.
  EXPECT_EQ(row_of(compare_results(noisy("a", 0), noisy("b", 1), nullptr), -1, kPosition).verdict, Verdict::worse);
}

TEST(Comparison, NoiseAloneIsNeverWorseOrBetter) {
  for (int trial = 0; trial < 20; ++trial) {
    const NamedResult a = noisy(std::to_string(trial) + "a", 0), b = noisy(std::to_string(trial) + "b", 0);
    for (const ComparisonRow& row : compare_results(a, b, nullptr, {}, {.resamples = 500}).rows)
      EXPECT_TRUE(row.verdict == Verdict::same || row.verdict == Verdict::not_enough_data) << row.experiment;
  }
}

std::vector<const Metric*> every_metric() {
  const Protocol ours = make_protocol("");
  return shared_metrics(ours, ours);
}

TEST(Comparison, IntervalsHoldTheTruthAtLeastAsOftenAsTheySay) {
  // 20 rows at a family error of 0.9 leave 4.5% for each. The true difference is 0.1 mm.
  constexpr int kTrials = 400;
  const CompareConfig config = {.family_error = 0.9, .resamples = 400};
  Draws draws(config.seed, config.resamples);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto a = noisy_experiment("Tr1", kSeeds, 128, std::to_string(trial) + "a", 0);
    const auto b = noisy_experiment("Tr1", kSeeds, 128, std::to_string(trial) + "b", 0.1);
    const auto rows = comparison_rows({every_metric(), {{&a, &b}}, {}, {}}, nullptr, config, draws);
    held += *rows[gated_metrics().size()].low <= 0.1 && 0.1 <= *rows[gated_metrics().size()].high;
  }
  EXPECT_GE(held, 0.95 * kTrials);
  EXPECT_LT(held, kTrials) << "an interval without limits would hold everything";
}

TEST(Comparison, ExperimentsOnOneTrajectoryAreNotIndependent) {
  const auto compare = [](const std::string& other) {
    auto first = noisy_experiment("Tr1", {1}, 128, "a", 0), second = first;
    auto changed = noisy_experiment("Tr1", {1}, 128, "b", 0), changed_second = changed;
    second.key.database = changed_second.key.database = "DB_20_postures";
    second.key.trajectory = changed_second.key.trajectory = other;
    const CompareConfig config;
    Draws draws(config.seed, config.resamples);
    return comparison_rows({every_metric(), {{&first, &changed}, {&second, &changed_second}}, {}, {}}, nullptr,
                           config, draws);
  };
  const auto same = compare("Tr1"), different = compare("Tr2");
  const auto width = [](const ComparisonRow& row) { return *row.high - *row.low; };
  EXPECT_EQ(same[0].blocks, 8);
  EXPECT_NEAR(width(same[0]), width(same[gated_metrics().size()]), 1e-9) << "the second one says nothing new";
  EXPECT_EQ(different[0].blocks, 16);
  EXPECT_LT(width(different[0]), 0.75 * width(different[gated_metrics().size()]));
}

TEST(Comparison, EnoughFramesAreEnough) {
  const auto row_of_frames = [](int frames, double shift_mm) {
    const auto before = noisy_experiment("Tr1", {1}, frames, "a", 0);
    const auto after = noisy_experiment("Tr1", {1}, frames, "b", shift_mm);
    return row_of(compare_results(example_named("a", {before}), example_named("b", {after}), nullptr), 0,
                  kPosition);
  };
  for (const double shift_mm : {0.0, 0.3}) {
    const ComparisonRow few = row_of_frames(96, shift_mm);
    ASSERT_EQ(few.verdict, Verdict::not_enough_data);
    ASSERT_GT(few.enough_frames, few.frames);
    // Half as many again, since the spread of the few is itself an estimate.
    const ComparisonRow more = row_of_frames(few.enough_frames * 3 / 2, shift_mm);
    EXPECT_NE(more.verdict, Verdict::not_enough_data) << few.enough_frames;
    EXPECT_EQ(more.enough_frames, 0);
  }
}

TEST(Comparison, FewBlocksAreSaidInWords) {
  const Comparison comparison =
      compare_results(of_positions(positions({2, 2})), of_positions(positions({3, 5})), nullptr);
  EXPECT_EQ(interval_text(row_of(comparison, 0, kPosition)), "too few frames");
  EXPECT_EQ(enough_text(row_of(comparison, 0, kPosition), {}), "");  // worse in places: decided
  EXPECT_EQ(interval_text(row_of(comparison, 0, kRotation)), "[+0.000, +0.000]") << "decided: the same";
  const Comparison small =
      compare_results(of_positions(positions({2, 2})), of_positions(positions({2, 2.3})), nullptr);
  EXPECT_EQ(enough_text(row_of(small, 0, kPosition), {}), "at least 80 frames of a movement; 32 now");
  std::vector<std::optional<double>> nearly_lost(96);
  nearly_lost[3] = 2.1;
  const Comparison lost =
      compare_results(of_positions(positions({2, 2, 2, 2, 2, 2})), of_positions(nearly_lost), nullptr);
  EXPECT_EQ(enough_text(row_of(lost, 0, kPosition), {}), "at least 80 frames with a value; 1 now");
}

TEST(Comparison, EqualFramesAreTheSameHoweverFew) {
  const auto of_one_block = [](double last) {
    return compare_results(of_positions({3.0, std::nullopt, 3.0}), of_positions({3.0, std::nullopt, last}),
                           nullptr);
  };
  const auto outcome_of = [](const Comparison& comparison) {
    ComparisonReport report;
    report.comparison = comparison;
    return outcome_line(report);
  };
  const Comparison equal = of_one_block(3);
  for (const int e : {-1, 0}) {
    EXPECT_EQ(row_of(equal, e, kPosition).verdict, Verdict::same);
    EXPECT_EQ(interval_text(row_of(equal, e, kPosition)), "equal");
  }
  EXPECT_THAT(outcome_of(equal), HasSubstr(" 0 not enough data; equal in every frame"));
  const Comparison other = of_one_block(3.1);
  EXPECT_EQ(row_of(other, 0, kPosition).verdict, Verdict::not_enough_data);
  EXPECT_THAT(outcome_of(other), testing::Not(HasSubstr("equal")));
  const Comparison found = compare_results(of_positions({3.0, std::nullopt}), of_positions({3.0, 3.0}), nullptr);
  EXPECT_EQ(row_of(found, 0, kPosition).verdict, Verdict::not_enough_data) << "found in one alone";
}

TEST(Comparison, ChosenMetricsMakeASmallerFamily) {
  const NamedResult before = noisy("a", 0), after = noisy("b", 0);
  const std::vector<std::string> chosen = {std::string(kPosition)};
  const Comparison all = compare_results(before, after, nullptr),
                   one = compare_results(before, after, nullptr, {.metrics = chosen});
  ASSERT_EQ(one.rows.size(), 4U);
  EXPECT_LT(*one.rows[0].high, *row_of(all, -1, kPosition).high);
  EXPECT_EQ(one.preselected, chosen);
  EXPECT_THAT(comparison_explanation(one), HasSubstr("The metrics were chosen before: position_error_mm."));
  EXPECT_THROW(compare_results(before, after, nullptr, {.metrics = {"mood_deg"}}), Incomparable);
}

TEST(Comparison, AllExperimentsCountAlike) {
  NamedResult before = noisy("a", 0), after = noisy("a", 0);
  after.result.experiments[1] = noisy_experiment("Tr4", kSeeds, 128, "a", 0.9);
  const Comparison comparison = compare_results(before, after, nullptr);
  EXPECT_NEAR(*row_of(comparison, -1, kPosition).difference, 0.3, 1e-9);
  EXPECT_EQ(row_of(comparison, -1, kPosition).pairs, 3 * 256);
  EXPECT_EQ(row_of(comparison, -1, kPosition).blocks, 3 * 8);
}

TEST(Comparison, LostFramesShowInTheSharesNotInTheErrors) {
  auto after = positions({3, 3, 3, 3});
  for (int f = 20; f < 28; ++f) after[f].reset();
  const Comparison comparison =
      compare_results(of_positions(positions({3, 3, 3, 3})), of_positions(after), nullptr);
  EXPECT_EQ(row_of(comparison, 0, kPosition).pairs, 56);
  EXPECT_EQ(row_of(comparison, 0, kPosition).difference, 0);
  EXPECT_EQ(row_of(comparison, 0, kUncovered).pairs, 64);
  EXPECT_DOUBLE_EQ(*row_of(comparison, 0, kUncovered).difference, 12.5);
  EXPECT_EQ(comparison.frames[0].differences[place_of(kPosition)].values[24], std::nullopt);
  EXPECT_EQ(comparison.frames[0].differences[place_of(kUncovered)].values[24], 100);
}

TEST(Comparison, TooLittleHasNoInterval) {
  const auto compare = [](const std::vector<std::optional<double>>& before,
                          const std::vector<std::optional<double>>& after) {
    return compare_results(of_positions(before), of_positions(after), nullptr);
  };
  const auto expect_none = [](const Comparison& comparison, std::optional<double> difference, int blocks) {
    for (const int e : {-1, 0}) {
      const ComparisonRow& row = row_of(comparison, e, kPosition);
      EXPECT_EQ(row.difference, difference);
      EXPECT_EQ(row.blocks, blocks);
      EXPECT_EQ(row.low, std::nullopt);
      EXPECT_EQ(row.high, std::nullopt);
      EXPECT_EQ(row.verdict, Verdict::not_enough_data);
    }
  };
  expect_none(compare({}, {}), std::nullopt, 0);
  expect_none(compare({1.0}, {2.0}), 1.0, 1);
  expect_none(compare(positions({1}), positions({4})), 3.0, 1);
  const std::vector<std::optional<double>> lost(64);
  expect_none(compare(positions({1, 1, 1, 1}), lost), std::nullopt, 0);
  auto nearly_lost = lost;
  nearly_lost[3] = 2.0;  // only one block has a pair, so the variation is unknown
  expect_none(compare(positions({1, 1, 1, 1}), nearly_lost), 1.0, 1);
}

TEST(Comparison, VerdictsNeedSignificanceAndEffect) {
  const auto verdict = [](double low, double high, double effect) {
    ComparisonRow row;
    row.low = low;
    row.high = high;
    row.difference = (low + high) / 2;
    row.minimum_effect = effect;
    return verdict_of(row);
  };
  EXPECT_EQ(verdict(0.1, 0.5, 0.2), Verdict::worse);
  EXPECT_EQ(verdict(-0.5, -0.1, 0.2), Verdict::better);
  EXPECT_EQ(verdict(0.1, 0.5, 0.4), Verdict::not_enough_data) << "significant, but too small to count";
  EXPECT_EQ(verdict(-0.1, 0.5, 0.15), Verdict::not_enough_data) << "large, but not significant";
  EXPECT_EQ(verdict(0.1, 0.3, 0.4), Verdict::same) << "significant, and surely too small";
  EXPECT_EQ(verdict(-0.3, -0.1, 0.4), Verdict::same);
  EXPECT_EQ(verdict(-0.4, 0.1, 0.4), Verdict::not_enough_data) << "reaches the minimum effect";
  EXPECT_EQ(verdict(0, 0, 0.2), Verdict::same);
  EXPECT_EQ(verdict(0.2, 0.2, 0.2), Verdict::worse) << "exactly the minimum effect, without any spread";
  EXPECT_EQ(verdict(1e-12, 0.6, 0.2), Verdict::not_enough_data) << "dust does not decide";
  EXPECT_EQ(verdict_of({}), Verdict::not_enough_data);
}

TEST(Comparison, DustIsNoDifference) {
  const Comparison comparison = compare_results(
      of_positions(positions({3, 2, 1})), of_positions(positions({3 + 1e-15, 2 + 1e-15, 1 + 1e-15})), nullptr);
  EXPECT_EQ(row_of(comparison, 0, kPosition).verdict, Verdict::same);
}

TEST(Comparison, MinimumEffectsComeFromTheNoiseFloorWithinBounds) {
  const Metric &position = metric_of(kPosition), &uncovered = metric_of(kUncovered);
  NoiseFloor floor;
  floor.seeds_per_result = 2;
  floor.entries = {{"a", "position_error_mm", 0, 0.07, 0}, {"b", "position_error_mm", 0, 0.001, 0}};
  EXPECT_EQ(minimum_effect(position, "a", 200, 2, nullptr), 0.2);
  EXPECT_EQ(minimum_effect(position, "a", 200, 2, &floor), 0.07);
  EXPECT_EQ(minimum_effect(position, "b", 200, 2, &floor), 0.01) << "never below what another machine does";
  EXPECT_EQ(minimum_effect(position, "c", 200, 2, &floor), 0.2);
  EXPECT_DOUBLE_EQ(minimum_effect(position, "a", 200, 1, &floor), 0.07 * std::sqrt(2.0))
      << "one seed instead of two";
  EXPECT_EQ(minimum_effect(position, "a", 200, 8, &floor), 0.07);
  EXPECT_EQ(minimum_effect(uncovered, "a", 1000, 2, &floor), 1);
  EXPECT_EQ(minimum_effect(uncovered, "a", 50, 2, &floor), 4) << "two frames";
  EXPECT_EQ(minimum_effect(uncovered, "a", 0, 2, &floor), 1);
}

TEST(Comparison, WorstFramesAreDistinct) {
  auto before = positions({3, 3, 3, 3, 3, 3, 3, 3, 3}), after = before;
  after[40] = 13.0;
  after[44] = 12.0;  // the same failure as 40
  after[60].reset();
  before[80].reset();
  after[80].reset();
  before[90].reset();  // found again
  after[100] = 3.004;  // too small a change
  const Comparison comparison = compare_results(of_positions(before), of_positions(after), nullptr);
  ASSERT_EQ(comparison.worst.size(), 2u);
  EXPECT_EQ(comparison.worst[0].frame, 60);
  EXPECT_EQ(comparison.worst[0].candidate_vertex_error_mm, std::nullopt);
  EXPECT_EQ(comparison.worst[1].frame, 40);
  EXPECT_EQ(comparison.worst[1].baseline_vertex_error_mm, 3.75);
  EXPECT_EQ(comparison.worst[1].baseline_seed, 1u);
  const Comparison all =
      compare_results(of_positions(positions({3, 3, 3, 3, 3})), of_positions(positions({4, 5, 6, 7, 8})), nullptr);
  EXPECT_EQ(all.worst.size(), static_cast<size_t>(kWorstFrames));
  EXPECT_EQ(all.worst[0].frame, 64) << "of equal ones the first";
}

TEST(Comparison, SaysWhatTheConfigurationsDifferIn) {
  NamedResult before = noisy("a", 0), after = noisy("a", 0);
  before.result.configuration = {{"tracker", {{"icp", {{"max_iterations", 30}, {"old", true}}}, {"k", 4}}}};
  after.result.configuration = {{"tracker", {{"icp", {{"max_iterations", 5}}}, {"k", 4}, {"new", "x"}}}};
  const auto changes = compare_results(before, after, nullptr).configuration;
  ASSERT_EQ(changes.size(), 3u);
  const auto expect = [](const ConfigurationChange& change, const char* field, const char* from, const char* to) {
    EXPECT_EQ(change.field, field);
    EXPECT_EQ(change.baseline, from);
    EXPECT_EQ(change.candidate, to);
  };
  expect(changes[0], "icp.max_iterations", "30", "5");
  expect(changes[1], "icp.old", "true", "");
  expect(changes[2], "new", "", "\"x\"");
}

TEST(Comparison, SaysWhatWasCompared) {
  NamedResult before = noisy("old", 0), after = noisy("new", 0);
  after.result.commit = "abc";
  for (ExperimentResult& experiment : after.result.experiments) experiment.runs[0].seed = 7;
  const NoiseFloor floor;
  const Comparison comparison = compare_results(before, after, &floor, {.other_seeds = true});
  EXPECT_EQ(comparison.baseline.name, "old");
  EXPECT_EQ(comparison.candidate.commit, "abc");
  EXPECT_TRUE(comparison.other_seeds);
  EXPECT_TRUE(comparison.has_noise_floor);
  EXPECT_THAT(
      comparison_explanation(comparison),
      AllOf(HasSubstr("For these trajectories"), HasSubstr("all 44 together"), HasSubstr("1% of comparisons"),
            HasSubstr("other noise seeds, so"), HasSubstr("at least 16 successive")));
}

TEST(Comparison, IsTheSameEveryTime) {
  const NamedResult before = noisy("a", 0), after = noisy("b", 0);
  const auto lows = [](const Comparison& comparison) {
    std::vector<std::optional<double>> values;
    for (const ComparisonRow& row : comparison.rows) values.push_back(row.low);
    return values;
  };
  EXPECT_EQ(lows(compare_results(before, after, nullptr)), lows(compare_results(before, after, nullptr)));
}

}  // namespace
}  // namespace glovebench::reports
