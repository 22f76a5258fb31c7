#include "reports/claims/verdicts.h"
#include "core/tracker/tracker_config.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

Claim example_claim(Rule rule, ClaimKind kind = ClaimKind::reproduction, bool required = false) {
  ClaimChange written;
  written.definition.measure = "m";
  written.definition.rule = rule;
  written.definition.kind = kind;
  written.definition.required = required;
  return {"example", {written}};
}

const Rule kBelow10 = {.kind = Rule::Kind::below, .high = 10};
const Rule kWithin = {Rule::Kind::within, 5, 15};

Measure with_interval(double value, double low, double high) {
  return {"m", "mm", value, ConfidenceInterval{low, high, 0.95, 1, 8, 15, "example"}, false};
}

ClaimOutcome outcome_of(const Claim& claim, const std::vector<Measure>& measures) {
  return judge({claim}, measures).front().outcome;
}

TEST(Judge, WithoutAnIntervalByItsValue) {
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {{"m", "mm", 9.9, {}, false}}), ClaimOutcome::reproduced);
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {{"m", "mm", 10, {}, false}}), ClaimOutcome::not_reproduced);
  EXPECT_EQ(outcome_of(example_claim(kWithin, ClaimKind::consistency), {{"m", "cm", 5, {}, false}}),
            ClaimOutcome::consistent);
  EXPECT_EQ(outcome_of(example_claim(kWithin, ClaimKind::consistency), {{"m", "cm", 4, {}, false}}),
            ClaimOutcome::not_consistent);
}

TEST(Judge, ByTheWholeInterval) {
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(8, 7, 9.9)}), ClaimOutcome::reproduced);
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(8, 7, 10)}), ClaimOutcome::inconclusive);
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(12, 9, 14)}), ClaimOutcome::not_reproduced)
      << "the number breaks the rule, whatever the interval";
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(12, 7, 9)}), ClaimOutcome::not_reproduced);
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(8, 10, 14)}), ClaimOutcome::not_reproduced)
      << "no part of the interval holds";
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(12, 10, 14)}), ClaimOutcome::not_reproduced);
  EXPECT_EQ(outcome_of(example_claim(kWithin), {with_interval(10, 6, 14)}), ClaimOutcome::reproduced);
  EXPECT_EQ(outcome_of(example_claim(kWithin), {with_interval(10, 1, 20)}), ClaimOutcome::inconclusive)
      << "both ends are outside, but what lies between is not";
  EXPECT_EQ(outcome_of(example_claim(kWithin), {with_interval(2, 1, 4)}), ClaimOutcome::not_reproduced);
}

TEST(Judge, WhatWasNotRunOrHasNoValue) {
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {{"other", "mm", 1, {}, false}}), ClaimOutcome::not_run);
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {{"m", "mm", {}, {}, false}}), ClaimOutcome::inconclusive);
  EXPECT_FALSE(any_was_run(judge({example_claim(kBelow10)}, {})));
  EXPECT_TRUE(any_was_run(judge({example_claim(kBelow10)}, {{"m", "mm", {}, {}, false}})));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Measure without_interval(std::optional<double> value) { return {"m", "mm", value, {}, false}; }

/// A measure and its outcome for the rule "below 10".
struct Case {
  const char* what;
  std::optional<Measure> measure;
  int sign;                 ///< 1: holds, -1: does not, 0: inconclusive
  RequiredClaims required;  ///< if the claim is required
};
const RequiredClaims kHolds = {.hold = 1}, kUnsure = {.inconclusive = 1}, kFails = {.failed = 1},
                     kNotRun = {.not_run = 1};
const std::vector<Case> kCases = {
    {"holds, no interval", without_interval(9), 1, kHolds},
    {"breaks, no interval", without_interval(11), -1, kFails},
    {"on the bound of an open rule", without_interval(10), -1, kFails},
    {"holds, the interval holds", with_interval(9, 8, 9.5), 1, kHolds},
    {"holds, the interval crosses", with_interval(9, 8, 12), 0, kUnsure},
    {"holds, the interval breaks", with_interval(9, 11, 12), -1, kFails},
    {"breaks, the interval crosses", with_interval(11, 9, 12), -1, kFails},
    {"breaks, the interval holds", with_interval(11, 8, 9), -1, kFails},
    {"breaks, the interval breaks", with_interval(11, 10.5, 12), -1, kFails},
    {"no number", without_interval({}), 0, kFails},
    {"NaN", without_interval(kNan), 0, kFails},
    {"an infinite number that satisfies the rule", without_interval(-kInfinite), 0, kFails},
    {"NaN with an interval that holds", with_interval(kNan, 8, 9), 0, kFails},
    {"holds, NaN in the interval", with_interval(9, kNan, 9.5), 0, kFails},
    {"breaks, NaN in the interval", with_interval(11, 9, kNan), -1, kFails},
    {"holds, an interval that ends before it begins", with_interval(9, 9.5, 8), 0, kFails},
    {"not run", std::nullopt, 0, kNotRun},
};

TEST(Judge, EveryCombinationOfNumberAndInterval) {
  for (const auto& [what, measure, sign, required] : kCases) {
    const std::vector<Measure> measures = measure ? std::vector{*measure} : std::vector<Measure>{};
    for (const ClaimKind kind : {ClaimKind::reproduction, ClaimKind::consistency}) {
      const bool reproduction = kind == ClaimKind::reproduction;
      const ClaimOutcome holds = reproduction ? ClaimOutcome::reproduced : ClaimOutcome::consistent;
      const ClaimOutcome not_so = reproduction ? ClaimOutcome::not_reproduced : ClaimOutcome::not_consistent;
      const ClaimOutcome neither = measure ? ClaimOutcome::inconclusive : ClaimOutcome::not_run;
      for (const bool is_required : {false, true}) {
        const auto verdicts = judge({example_claim(kBelow10, kind, is_required)}, measures);
        EXPECT_EQ(verdicts[0].outcome, sign > 0 ? holds : sign < 0 ? not_so : neither) << what;
        EXPECT_EQ(count_required(verdicts), is_required ? required : RequiredClaims{}) << what;
      }
    }
  }
}

TEST(Judge, NumbersOfVerdictsCanBeWritten) {
  for (const Case& example : kCases) {
    if (!example.measure) continue;
    const ClaimVerdict verdict = judge({example_claim(kBelow10)}, {*example.measure})[0];
    EXPECT_TRUE(!verdict.measure->value || std::isfinite(*verdict.measure->value)) << example.what;
    const auto& interval = verdict.measure->interval;
    EXPECT_TRUE(!interval || (std::isfinite(interval->low) && interval->low <= interval->high)) << example.what;
  }
}

TEST(PValue, IsFivePercentWhereTheIntervalTouchesTheBound) {
  const auto p = [](const Rule& rule, double value, double low, double high) {
    return p_value(rule, value, *with_interval(value, low, high).interval);
  };
  EXPECT_NEAR(p(kBelow10, 8, 6, 10), 0.05, 1e-9);
  EXPECT_NEAR(p(kBelow10, 8, 7, 10), 0.05, 1e-9) << "only the arm toward the bound counts";
  EXPECT_NEAR(p(kBelow10, 8, 2, 9), p(kBelow10, 8, 4.5, 11.5), 1e-9) << "but not less than half the width";
  EXPECT_GT(p(kBelow10, 9, 7, 11), 0.05);
  // Tables of Student's t: with 4 degrees of freedom |T| is over 2.776 in 5% and over 4.604 in 1%.
  EXPECT_NEAR(p(kBelow10, 10 - 4.604, 10 - 4.604 - 2.776, 10 - 4.604 + 2.776), 0.01, 2e-5);
  EXPECT_EQ(p(kBelow10, 10, 9, 11), 1);
  EXPECT_EQ(p(kBelow10, 9, 9, 9), 0) << "nothing varies";
  EXPECT_NEAR(p(kWithin, 6, 5, 7), 0.05, 1e-9) << "the nearer bound";
}

/// Required claims that are measured with intervals of +-1 at these distances below the bound.
std::vector<ClaimVerdict> judged_at(const std::vector<double>& distances) {
  std::vector<Claim> claims;
  std::vector<Measure> measures;
  for (const double distance : distances) {
    Claim claim = example_claim(kBelow10, ClaimKind::reproduction, true);
    claim.history[0].definition.measure = "m" + std::to_string(claims.size());
    measures.push_back(with_interval(10 - distance, 9 - distance, 11 - distance));
    measures.back().name = claim.definition().measure;
    claims.push_back(claim);
  }
  return judge(claims, measures);
}

TEST(Judge, RequiredClaimsTogether) {
  const auto outcomes = [](const std::vector<double>& distances) {
    std::string text;
    for (const ClaimVerdict& verdict : judged_at(distances))
      text += verdict.outcome == ClaimOutcome::reproduced ? '+' : '?';
    return text;
  };
  EXPECT_EQ(outcomes({1.1}), "+");
  EXPECT_EQ(outcomes({1.1, 1.1}), "??") << "each alone would hold";
  EXPECT_EQ(outcomes({1.1, 2}), "++") << "the second step compares with 5%";
  EXPECT_EQ(outcomes({2, 1.1, 1.1}), "+??");
  EXPECT_EQ(outcomes({0.9, 2}), "?+");
  const auto verdicts = judged_at({1.1, 1.1});
  EXPECT_EQ(count_required(verdicts), (RequiredClaims{.inconclusive = 2}));
  EXPECT_DOUBLE_EQ(*verdicts[0].p, 2 * p_value(kBelow10, 8.9, *with_interval(8.9, 7.9, 9.9).interval));
}

TEST(Judge, ARequiredClaimWithoutANumberCountsAgainstTheOthers) {
  Claim missing = example_claim(kBelow10, ClaimKind::reproduction, true), present = missing;
  missing.history[0].definition.measure = "none";
  const auto verdicts = judge({missing, present}, {with_interval(8.9, 7.9, 9.9)});
  EXPECT_EQ(verdicts[0].outcome, ClaimOutcome::not_run);
  EXPECT_FALSE(verdicts[0].p.has_value());
  EXPECT_EQ(verdicts[1].outcome, ClaimOutcome::inconclusive);
}

TEST(Judge, AWithdrawnClaimIsNotJudgedAndFailsNothing) {
  Claim claim = example_claim(kBelow10, ClaimKind::reproduction, true);
  claim.history.back().definition.withdrawn = true;
  for (const auto& measures : {std::vector<Measure>{}, std::vector{without_interval(11)}}) {
    const auto verdicts = judge({claim}, measures);
    EXPECT_EQ(verdicts[0].outcome, ClaimOutcome::withdrawn);
    EXPECT_EQ(count_required(verdicts), RequiredClaims{});
    EXPECT_FALSE(any_was_run(verdicts));
  }
}

TEST(Judge, OnlyTheConfigurationOfThePaperAndNoQuickRun) {
  RunResult result = full_result();
  result.configuration = {{"tracker", to_json(profile("paper"))}};
  EXPECT_FALSE(all_measures(result).empty());
  EXPECT_TRUE(are_claims_judged(result));
  RunResult quick = result, other = result;
  quick.configuration["quick"] = true;
  other.configuration["tracker"]["method"] = "monocular_bbox";
  EXPECT_FALSE(are_claims_judged(quick) || are_claims_judged(other));
  EXPECT_TRUE(all_measures(quick).empty());
  EXPECT_TRUE(all_measures(other).empty());
}

TEST(Judge, MeasuresOfTheFiguresAndOfStudies) {
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(full_result()));
  ASSERT_EQ(verdicts.size(), claims().size());
  const auto outcome = [&](const std::string& measure) {
    const auto it = std::ranges::find_if(
        verdicts, [&](const ClaimVerdict& v) { return v.claim.definition().measure == measure; });
    return it == verdicts.end() ? "no such claim" : to_string(it->outcome);
  };
  EXPECT_EQ(outcome("figure4.largest_mean_position_error_mm_source"), "reproduced");
  EXPECT_EQ(outcome("figure7.steps_with_lower_rank"), "inconclusive") << "from 5 to 6 of 6";
  EXPECT_EQ(outcome("figure8.time_share"), "reproduced");
  EXPECT_EQ(outcome("figure8.tiny_time_share"), "not reproduced");
  EXPECT_EQ(outcome("monocular.depth_error_cm"), "not run");
}

}  // namespace
}  // namespace glovebench::reports
