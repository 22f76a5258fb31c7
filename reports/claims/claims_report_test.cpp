#include "reports/claims/claims_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/example_result.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;
using testing::Not;

ClaimVerdict example_verdict(ClaimOutcome outcome, std::optional<Measure> measure) {
  ClaimDefinition claim;
  claim.claim = "Is <small>.";
  claim.source = "section IX";
  claim.quote = "It is <tiny>.";
  claim.ours = true;
  claim.measured = "Its size.";
  claim.measure = "size";
  claim.rule = {.kind = Rule::Kind::below, .high = 2.5};
  claim.required = true;
  claim.if_not = "It is large.";
  ClaimDefinition before = claim;
  before.rule.high = 9;
  const std::vector<ClaimChange> history = {
      {"2026-01-02", "0123456", before, {"rule", "paper_value"}, "8 < 9 mm: reproduced", "First written."},
      {"2026-01-03", std::nullopt, claim, {"rule"}, std::nullopt, "Nine is <large>."}};
  return {{"fast, and \"small\"", history}, std::move(measure), outcome};
}

const Measure kLarge = {"size", "mm", 3.14159265, ConfidenceInterval{3, 3.25, 0.95, 1, 2, 15, "x"}, false};
const std::vector<ClaimVerdict> kFailed = {example_verdict(ClaimOutcome::not_reproduced, kLarge)};
const std::vector<ClaimVerdict> kNotRunClaim = {example_verdict(ClaimOutcome::not_run, std::nullopt)};

TEST(ClaimsReport, NumbersHaveFourDigitsAndTheirUnit) {
  EXPECT_EQ(measured_text(kFailed[0]), "3.142 [3, 3.25] mm");
  EXPECT_EQ(rule_text(kFailed[0]), "below 2.5 mm (ours)");
  EXPECT_EQ(measured_text(kNotRunClaim[0]), "-");
  EXPECT_EQ(rule_text(kNotRunClaim[0]), "below 2.5 (ours)");
  ClaimVerdict with_p = kFailed[0];
  with_p.p = 0.01234;
  EXPECT_EQ(measured_text(with_p), "3.142 [3, 3.25] mm, p 0.012");
  EXPECT_EQ(measured_text(example_verdict(ClaimOutcome::inconclusive, Measure{"size", "", {}, {}, false})), "-");
}

TEST(ClaimsReport, CountsOutcomes) {
  std::vector<ClaimVerdict> verdicts = {kFailed[0], kNotRunClaim[0], kNotRunClaim[0]};
  EXPECT_EQ(count_text(verdicts), "3 claims: 1 not reproduced, 2 not run");
  EXPECT_EQ(required_text(verdicts), "3 required (*): 0 hold, 0 inconclusive, 1 failed, 2 not run");
  verdicts = {example_verdict(ClaimOutcome::reproduced, kLarge),
              example_verdict(ClaimOutcome::inconclusive, kLarge), example_verdict(ClaimOutcome::withdrawn, {})};
  EXPECT_EQ(count_text(verdicts), "3 claims: 1 reproduced, 1 inconclusive, 1 withdrawn");
  EXPECT_EQ(required_text(verdicts), "2 required (*): 1 hold, 1 inconclusive, 0 failed, 0 not run");
  EXPECT_THAT(claims_table(verdicts), HasSubstr("inconclusive   * fast"));
}

TEST(ClaimsReport, CountsWhatWouldComeOutByChance) {
  std::vector<ClaimVerdict> verdicts(21, example_verdict(ClaimOutcome::reproduced, kLarge));
  for (size_t i = 0; i < 20; ++i) verdicts[i].claim.history.back().definition.required = false;
  EXPECT_THAT(chance_text(verdicts), HasSubstr("Of 20 other claims judged by a 95% interval, about 1.0 (20 x 5%)"));
  verdicts[0].outcome = ClaimOutcome::withdrawn;
  verdicts[1].measure->interval.reset();
  verdicts[2].measure.reset();
  EXPECT_THAT(chance_text(verdicts), HasSubstr("Of 17 other claims"));
  for (const std::string& text : {claims_table(verdicts), claims_markdown(verdicts), claims_section(verdicts)})
    EXPECT_THAT(text, HasSubstr("Of 17 other claims"));
}

TEST(ClaimsReport, QuotesAndMarksAreEverywhere) {
  EXPECT_THAT(claims_table(kFailed), HasSubstr("\n\"It is <tiny>.\"\n"));
  EXPECT_THAT(claims_table(kFailed), HasSubstr("below 2.5 mm (ours)"));
  EXPECT_THAT(claims_markdown(kFailed), HasSubstr("| \"It is &lt;tiny>.\" |"));
  EXPECT_THAT(claims_markdown(kFailed), HasSubstr("| below 2.5 mm (ours) |"));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("<q>It is &lt;tiny&gt;.</q>"));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("below 2.5 mm (ours)"));
  const auto verdict = nlohmann::json::parse(claims_json(kFailed))["verdicts"][0];
  EXPECT_EQ(verdict["quote"], "It is <tiny>.");
  EXPECT_EQ(verdict["ours"], true);
}

TEST(ClaimsReport, WhatDoesNotHoldIsSaidEverywhere) {
  EXPECT_THAT(claims_table(kFailed), HasSubstr("It is large."));
  EXPECT_THAT(claims_markdown(kFailed),
              HasSubstr("| not reproduced, required | Is &lt;small>. Its size. It is large. |"));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("verdict worse\">not reproduced"));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("Is &lt;small&gt;."));
  EXPECT_THAT(claims_section(kFailed), HasSubstr("It is large."));
  EXPECT_EQ(
      claims_csv("a-1", kFailed),
      "run,id,outcome,required,kind,source,paper_value,measure,rule,ours,unit,value,value_low,value_high,holm_p,"
      "claim,quote\n"
      "a-1,\"fast, and \"\"small\"\"\",not reproduced,true,reproduction,section IX,,size,below "
      "2.5,true,mm,3.141593,"
      "3.0,3.25,,Is <small>.,It is <tiny>.\n");
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

TEST(ClaimsReport, TheSectionBeginsWithWhatFailedAndFoldsTheRest) {
  const std::string html = claims_section(
      {example_verdict(ClaimOutcome::reproduced, kLarge), kNotRunClaim[0], kFailed[0], kNotRunClaim[0]});
  const size_t failed = html.find("verdict worse\">not reproduced"),
               folded = html.find("<summary>Hold: 1</summary>");
  ASSERT_NE(failed, std::string::npos);
  ASSERT_NE(folded, std::string::npos);
  EXPECT_LT(failed, folded);
  EXPECT_LT(folded, html.find("<summary>Not run: 2</summary>"));
  EXPECT_THAT(html, Not(HasSubstr("Withdrawn")));
}

TEST(ClaimsReport, HistoriesAreTold) {
  const std::string html = claims_section(kFailed);
  for (const char* text : {"History: changed once", "<b>2026-01-02, commit 0123456</b>: First written.",
                           "<br/>rule: <ins>below 9</ins>", "Came out: 8 &lt; 9 mm: reproduced",
                           "<b>2026-01-03</b>: Nine is &lt;large&gt;.",
                           "<br/>rule: <del>below 9</del> <ins>below 2.5</ins>", "Came out: no run published"})
    EXPECT_THAT(html, HasSubstr(text));
  const auto json = nlohmann::json::parse(claims_json(kFailed));
  const auto& history = json["verdicts"][0]["history"];
  ASSERT_EQ(history.size(), 2U);
  EXPECT_EQ(history[0]["came_out"], "8 < 9 mm: reproduced");
  EXPECT_EQ(history[1]["set"]["rule"], "below 2.5");
  const auto own = nlohmann::json::parse(claims_json(judge(claims(), {})));
  EXPECT_EQ(own["verdicts"][0]["history"][0]["set"]["withdrawn"], false) << "no text";
  EXPECT_TRUE(history[1]["commit"].is_null());
  EXPECT_EQ(json["judging"].size(), claim_set().judging.size());
}

TEST(ClaimsReport, EveryHistoryOfThisProgramIsOnThePage) {
  const std::string html = claims_section(judge(claims(), all_measures(full_result())));
  size_t entries = claim_set().judging.size();
  for (const Claim& claim : claims()) {
    EXPECT_THAT(html, HasSubstr("id=\"claim-" + claim.id + "\""));
    entries += claim.history.size();
  }
  size_t found = 0;
  for (size_t at = html.find("<li>"); at != std::string::npos; at = html.find("<li>", at + 1)) ++found;
  EXPECT_EQ(found, entries);
  EXPECT_THAT(html, HasSubstr("160 ms: not consistent (7bbb283)"));
}

TEST(ClaimsReport, AWithdrawnClaimStaysInTheTables) {
  const std::vector<ClaimVerdict> verdicts = {example_verdict(ClaimOutcome::withdrawn, {}), kFailed[0]};
  EXPECT_THAT(claims_table(verdicts), HasSubstr("withdrawn"));
  EXPECT_THAT(claims_markdown(verdicts), HasSubstr("| withdrawn, required |"));
  EXPECT_THAT(claims_section(verdicts), HasSubstr("verdict unsure\">withdrawn"));
}

TEST(ClaimsReport, RunsWithoutClaimsFoldThemAway) {
  EXPECT_EQ(claims_markdown(kNotRunClaim), "");
  EXPECT_THAT(claims_section(kNotRunClaim), HasSubstr("<details><summary>Not run: 1</summary>"));
  const auto json = nlohmann::json::parse(claims_json(kNotRunClaim));
  EXPECT_TRUE(json["verdicts"][0]["measure"].is_null());
  EXPECT_EQ(json["required_claim_failed"], false);
}

TEST(ClaimsReport, TableFitsATerminal) {
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(full_result()));
  std::istringstream lines(claims_table(verdicts));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(text_width(line), 80u) << line;
  EXPECT_GT(count, 10);
  EXPECT_THAT(claims_markdown(verdicts), HasSubstr("Not run: posture-lags, lag-is-the-filter,"));
}

}  // namespace
}  // namespace glovebench::reports
