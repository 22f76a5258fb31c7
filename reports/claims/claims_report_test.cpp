#include "reports/claims/claims_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;
using testing::Not;

ClaimVerdict example_verdict(ClaimOutcome outcome, std::optional<Measure> measure) {
  Claim claim;
  claim.id = "fast, and \"small\"";
  claim.claim = "Is <small>.";
  claim.source = "section IX";
  claim.measured = "Its size.";
  claim.measure = "size";
  claim.rule = {.kind = Rule::Kind::below, .high = 2.5};
  claim.required = true;
  claim.if_not = "It is large.";
  return {claim, std::move(measure), outcome};
}

const Measure kLarge = {"size", "mm", 3.14159265, ConfidenceInterval{3, 3.25, 0.95, 1, 2, 15, "x"}, false};
const std::vector<ClaimVerdict> kFailed = {example_verdict(ClaimOutcome::not_reproduced, kLarge)};
const std::vector<ClaimVerdict> kNotRun = {example_verdict(ClaimOutcome::not_run, std::nullopt)};

TEST(ClaimsReport, NumbersHaveFourDigitsAndTheirUnit) {
  EXPECT_EQ(measured_text(kFailed[0]), "3.142 [3, 3.25] mm");
  EXPECT_EQ(rule_text(kFailed[0]), "below 2.5 mm");
  EXPECT_EQ(measured_text(kNotRun[0]), "-");
  EXPECT_EQ(rule_text(kNotRun[0]), "below 2.5");
  EXPECT_EQ(measured_text(example_verdict(ClaimOutcome::inconclusive, Measure{"size", "", {}, {}, false})), "-");
}

TEST(ClaimsReport, CountsOutcomes) {
  std::vector<ClaimVerdict> verdicts = {kFailed[0], kNotRun[0], kNotRun[0]};
  EXPECT_EQ(count_text(verdicts), "3 claims: 1 not reproduced, 2 not run");
}

TEST(ClaimsReport, WhatDoesNotHoldIsSaidEverywhere) {
  EXPECT_THAT(claims_table(kFailed), HasSubstr("It is large."));
  EXPECT_THAT(claims_markdown(kFailed),
              HasSubstr("| not reproduced, required | Is <small>. Its size. It is large. |"));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("verdict worse\">not reproduced"));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("Is &lt;small&gt;."));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("It is large."));
  EXPECT_EQ(
      claims_csv(kFailed),
      "id,outcome,required,kind,source,paper_value,measure,rule,unit,value,value_low,value_high,claim\n"
      "\"fast, and \"\"small\"\"\",not reproduced,true,reproduction,section IX,,size,below 2.5,mm,3.141593,3.0,"
      "3.25,Is <small>.\n");
  const auto json = nlohmann::json::parse(claims_json(kFailed));
  EXPECT_EQ(json["required_claim_failed"], true);
  EXPECT_EQ(json["verdicts"][0]["measure"]["interval"]["high"], 3.25);
  EXPECT_EQ(json["verdicts"][0]["if_not"], "It is large.");
}

TEST(ClaimsReport, WhatHoldsHasNoExcuse) {
  const std::vector<ClaimVerdict> verdicts = {example_verdict(ClaimOutcome::reproduced, kLarge)};
  for (const std::string& text : {claims_table(verdicts), claims_markdown(verdicts), claims_section(verdicts)})
    EXPECT_THAT(text, Not(HasSubstr("It is large.")));
}

TEST(ClaimsReport, RunsWithoutClaimsHaveNoSection) {
  EXPECT_EQ(claims_markdown(kNotRun), "");
  EXPECT_EQ(claims_section(kNotRun), "");
  const auto json = nlohmann::json::parse(claims_json(kNotRun));
  EXPECT_TRUE(json["verdicts"][0]["measure"].is_null());
  EXPECT_EQ(json["required_claim_failed"], false);
}

TEST(ClaimsReport, TableFitsATerminal) {
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(full_result()));
  std::istringstream lines(claims_table(verdicts));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 120u) << line;
  EXPECT_GT(count, 10);
  EXPECT_THAT(claims_markdown(verdicts), HasSubstr("Not run: posture-lags, lag-is-the-filter,"));
}

}  // namespace
}  // namespace glovebench::reports
