#include "reports/comparison/gate_rule.h"

#include <gmock/gmock.h>

#include "reports/comparison/example_comparison.h"
#include "reports/comparison/example_runs.h"
#include "reports/example_result.h"
#include "reports/results_json.h"

namespace glovebench::reports {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view kGatedPosition = "position_error_mm", kGatedUncovered = "uncovered_percent";

ComparisonRow row(std::string_view metric, double difference, Verdict verdict) {
  ComparisonRow row = example_row("Tr4_x", metric, 2.98, difference, 0.21, verdict);
  row.pairs = row.frames = 200;
  row.blocks = 8;
  row.minimum_effect = 0.12;
  return row;
}

Comparison of_rows(std::vector<ComparisonRow> rows) {
  Comparison comparison;
  comparison.has_noise_floor = true;
  comparison.rows = std::move(rows);
  return comparison;
}

TEST(Gate, WorseStops) {
  EXPECT_TRUE(stops(row(kGatedPosition, 0.52, Verdict::worse)));
  EXPECT_FALSE(stops(row(kGatedPosition, -0.52, Verdict::better)));
  EXPECT_FALSE(stops(row(kGatedPosition, 0.01, Verdict::same)));
  EXPECT_FALSE(stops(row(kGatedPosition, 0.23, Verdict::not_enough_data)));
}

TEST(Gate, TwiceTheMinimumEffectStopsWithoutSignificance) {
  ComparisonRow in_places = row(kGatedPosition, 0.24, Verdict::not_enough_data);
  EXPECT_TRUE(stops(in_places));
  EXPECT_THAT(decide(of_rows({in_places}), {}).failures,
              ElementsAre("Tr4_x, position_error_mm: worse in places, up by 0.24 mm [0.03, 0.45] (2.98 -> 3.22), "
                          "minimum effect 0.12"));
  in_places.low.reset();
  in_places.high.reset();
  EXPECT_TRUE(stops(in_places)) << "too short for an interval";
  EXPECT_FALSE(stops(row(kGatedPosition, -0.5, Verdict::not_enough_data)));
}

/// A result as another version of the program writes it.
NamedResult of_version(double shift_mm, const std::function<void(nlohmann::json&)>& change) {
  NamedResult named = example_named("run", {noisy_experiment("Tr4", {1, 2}, 117, "a", shift_mm)});
  for (ExperimentResult& e : named.result.experiments) e = summarize(e.key, e.runs, pck_curve({}, 0), {});
  nlohmann::json json = nlohmann::json::parse(results_json(named.result));
  change(json);
  named.result = parse_results(json.dump(), "results.json");
  return named;
}

TEST(Gate, AMetricOfOneVersionAloneDecidesNothing) {
  const auto none = [](nlohmann::json&) {};
  const auto other = [](nlohmann::json& json) {
    remove_metric(json, "icp_residual_mm");
    add_metric(json, "mood_deg");
  };
  for (const double shift_mm : {0.0, 1.0}) {
    const bool passed = shift_mm == 0;
    EXPECT_EQ(decide(compare_results(of_version(0, none), of_version(shift_mm, none), nullptr), {}).passed(),
              passed);
    for (const bool is_baseline : {false, true}) {
      const NamedResult baseline = is_baseline ? of_version(0, other) : of_version(0, none),
                        candidate = is_baseline ? of_version(shift_mm, none) : of_version(shift_mm, other);
      const Comparison comparison = compare_results(baseline, candidate, nullptr);
      EXPECT_EQ(decide(comparison, {}).passed(), passed);
      EXPECT_THAT(decide(comparison, {}).warnings,
                  testing::Contains("mood_deg: not compared, unknown to this program"));
      EXPECT_EQ(comparison.rows.size(), 2 * (gated_metrics().size() - 1));
      EXPECT_EQ(comparison.frames[0].differences.size(), gated_metrics().size() - 1);
      EXPECT_EQ(comparison.uncompared_metrics.at("icp_residual_mm"),
                is_baseline ? "not in the baseline" : "not in the candidate");
      EXPECT_EQ(comparison.uncompared_metrics.at("mood_deg"), "unknown to this program");
    }
  }
}

TEST(Gate, AStretchThatWentWrongStops) {
  const auto errors = [](double extra_mm) {
    return example_experiment("Tr4", {1, 2}, 117, [extra_mm](uint64_t, int f) {
      return example_frame(f, f >= 40 && f < 46 ? 3 + extra_mm : 3, 5, 3);
    });
  };
  const NamedResult before = example_named("before", {errors(0)}), after = example_named("after", {errors(10)});
  const Comparison comparison = compare_results(before, after, nullptr);
  EXPECT_FALSE(decide(comparison, {}).passed()) << "six frames of 117 are 0.5 mm of the mean";
  EXPECT_TRUE(decide(compare_results(before, before, nullptr), {}).passed());
}

TEST(Gate, AShareThatRoseByItsMinimumEffectStopsWithoutSignificance) {
  EXPECT_TRUE(stops(row(kGatedUncovered, 0.12, Verdict::not_enough_data)));
  EXPECT_TRUE(stops(row(kGatedUncovered, 0.12 - 4e-7, Verdict::not_enough_data))) << "rounded in a file";
  EXPECT_FALSE(stops(row(kGatedUncovered, 0.119, Verdict::not_enough_data)));
  EXPECT_FALSE(stops(row(kGatedUncovered, -0.5, Verdict::better)));
  ComparisonRow brief = row(kGatedUncovered, 5, Verdict::not_enough_data);
  brief.low.reset();
  brief.high.reset();
  EXPECT_TRUE(stops(brief)) << "too short for an interval";
  brief.difference.reset();
  EXPECT_FALSE(stops(brief));
}

TEST(Gate, LinesHoldTheNumbers) {
  const GateDecision decision = decide(
      of_rows({row(kGatedPosition, 0.52, Verdict::worse), row(kGatedPosition, 0.15, Verdict::not_enough_data),
               row(kGatedPosition, 0.05, Verdict::not_enough_data), row(kGatedPosition, -0.5, Verdict::better)}),
      {});
  EXPECT_FALSE(decision.passed());
  EXPECT_THAT(decision.failures,
              ElementsAre("Tr4_x, position_error_mm: worse by 0.52 mm [0.31, 0.73] (2.98 -> 3.50), minimum effect "
                          "0.12"));
  EXPECT_THAT(decision.warnings,
              ElementsAre("Tr4_x, position_error_mm: not enough data to tell, up by 0.15 mm [-0.06, 0.36] (2.98 -> "
                          "3.13), minimum effect 0.12"));
}

TEST(Gate, NothingWorsePasses) {
  const GateDecision decision =
      decide(of_rows({row(kGatedPosition, 0.01, Verdict::same)}), {{"look_up", 4, 3.9, 2.8, false}});
  EXPECT_TRUE(decision.passed());
  EXPECT_THAT(decision.warnings, IsEmpty());
}

TEST(Gate, WithoutANoiseFloorItWarns) {
  Comparison comparison = of_rows({});
  comparison.has_noise_floor = false;
  const GateDecision decision = decide(comparison, {});
  EXPECT_TRUE(decision.passed());
  EXPECT_THAT(decision.warnings, ElementsAre(testing::HasSubstr("no noise floor")));
}

TEST(Gate, ASlowerRatioStops) {
  const GateDecision decision =
      decide(of_rows({}), {{"look_up", 4, 1.5, 1.9, 2, true}, {"icp", 3, 3, 3, 1.5, false}});
  EXPECT_THAT(
      decision.failures,
      ElementsAre("look_up: slower: 1.50 times as fast as the plain implementation, 1.90 at best (it was 4.00), "
                  "limit 2.00"));
}

TEST(Gate, ARunOfLostFramesStops) {
  const auto experiment = [](int lost) {
    return example_experiment("Exit", {1, 2}, 100, [lost](uint64_t, int f) {
      return f >= 50 && f < 50 + lost ? example_lost_frame(f) : example_frame(f, 3, 5, 2);
    });
  };
  const NamedResult before = example_named("before", {experiment(4)});
  const auto gate = [&](int lost) {
    return decide(compare_results(before, example_named("after", {experiment(lost)}), nullptr), {});
  };
  EXPECT_TRUE(gate(4).passed());
  EXPECT_TRUE(gate(3).passed());
  EXPECT_FALSE(gate(5).passed()) << "one frame in both seeds: two of 200, the default of 1%";
}

}  // namespace
}  // namespace glovebench::reports
