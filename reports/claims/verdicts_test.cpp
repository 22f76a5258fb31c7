#include "reports/claims/verdicts.h"
#include "core/tracker/tracker_config.h"

#include <gmock/gmock.h>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

Claim example_claim(Rule rule, ClaimKind kind = ClaimKind::reproduction, bool required = false) {
  Claim claim;
  claim.id = "example";
  claim.measure = "m";
  claim.rule = rule;
  claim.kind = kind;
  claim.required = required;
  return claim;
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
  EXPECT_EQ(outcome_of(example_claim(kBelow10), {with_interval(12, 9, 14)}), ClaimOutcome::inconclusive);
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

TEST(Judge, OnlyRequiredClaimsThatDoNotHoldFail) {
  const auto fails = [](bool required, const std::vector<Measure>& measures, ClaimKind kind) {
    return required_claim_failed(judge({example_claim(kBelow10, kind, required)}, measures));
  };
  const Measure bad = {"m", "mm", 11, {}, false};
  EXPECT_TRUE(fails(true, {bad}, ClaimKind::reproduction));
  EXPECT_TRUE(fails(true, {bad}, ClaimKind::consistency));
  EXPECT_FALSE(fails(false, {bad}, ClaimKind::reproduction));
  EXPECT_FALSE(fails(true, {with_interval(11, 9, 13)}, ClaimKind::reproduction)) << "inconclusive";
  EXPECT_FALSE(fails(true, {}, ClaimKind::reproduction)) << "not run";
  EXPECT_TRUE(fails(true, {{"m", "mm", {}, {}, false}}, ClaimKind::reproduction)) << "run, and without an answer";
}

TEST(Judge, OnlyTheConfigurationOfThePaperAndNoQuickRun) {
  RunResult result = full_result();
  result.configuration = {{"tracker", to_json(profile("paper"))}};
  EXPECT_FALSE(all_measures(result).empty());
  RunResult quick = result, other = result;
  quick.configuration["quick"] = true;
  other.configuration["tracker"]["method"] = "monocular_bbox";
  EXPECT_TRUE(all_measures(quick).empty());
  EXPECT_TRUE(all_measures(other).empty());
}

TEST(Judge, MeasuresOfTheFiguresAndOfStudies) {
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(full_result()));
  ASSERT_EQ(verdicts.size(), claims().size());
  const auto outcome = [&](const std::string& measure) {
    const auto it =
        std::ranges::find_if(verdicts, [&](const ClaimVerdict& v) { return v.claim.measure == measure; });
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
