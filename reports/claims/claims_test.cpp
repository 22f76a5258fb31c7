#include "reports/claims/claims.h"

#include <gmock/gmock.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "core/base/damaged_text.h"
#include "core/base/error.h"
#include "reports/embedded.h"
#include "reports/paper_numbers.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string claims_error(const std::function<void(json&)>& change) {
  json document = json::parse(embedded_claims());
  change(document);
  return thrown_by([&] { parse_claims(document.dump(), "claims.json"); });
}

const Claim* find_claim(const std::string& measure) {
  const auto it = std::ranges::find(claims(), measure, [](const Claim& c) { return c.definition().measure; });
  return it == claims().end() ? nullptr : &*it;
}

TEST(Rule, EndsAreInsideOrNot) {
  const Rule below = {.kind = Rule::Kind::below, .high = 10}, at_most = {.kind = Rule::Kind::at_most, .high = 10};
  const Rule above = {.kind = Rule::Kind::above, .low = 10}, at_least = {.kind = Rule::Kind::at_least, .low = 10};
  const Rule within = {Rule::Kind::within, 5, 15};
  EXPECT_TRUE(holds(below, 9.999) && !holds(below, 10) && !holds(below, 11));
  EXPECT_TRUE(holds(at_most, 10) && !holds(at_most, 10.001) && holds(at_most, -3));
  EXPECT_TRUE(holds(above, 10.001) && !holds(above, 10) && !holds(above, 9));
  EXPECT_TRUE(holds(at_least, 10) && !holds(at_least, 9.999));
  EXPECT_TRUE(holds(within, 5) && holds(within, 15) && !holds(within, 4.9) && !holds(within, 15.1));
}

TEST(Rule, IntervalsThatMeetIt) {
  const Rule below = {.kind = Rule::Kind::below, .high = 10}, above = {.kind = Rule::Kind::above, .low = 10};
  EXPECT_TRUE(meets(below, 9, 12) && !meets(below, 10, 12));
  EXPECT_TRUE(meets(above, 9, 12) && !meets(above, 9, 10));
  const Rule within = {Rule::Kind::within, 5, 15};
  EXPECT_TRUE(meets(within, 0, 20) && meets(within, 15, 20) && !meets(within, 16, 20) && !meets(within, 0, 4));
  EXPECT_THROW(meets(within, 20, 0), std::logic_error);
}

TEST(Rule, Text) {
  EXPECT_EQ(to_string(Rule{.kind = Rule::Kind::below, .high = 66.7}), "below 66.7");
  EXPECT_EQ(to_string(Rule{.kind = Rule::Kind::at_most, .high = 10}), "at most 10");
  EXPECT_EQ(to_string(Rule{.kind = Rule::Kind::above, .low = 0}), "above 0");
  EXPECT_EQ(to_string(Rule{.kind = Rule::Kind::at_least, .low = 12}), "at least 12");
  EXPECT_EQ(to_string(Rule{Rule::Kind::within, 5, 15}), "within 5..15");
}

TEST(Claims, RequiredAreThosePositionAndOrder) {
  std::vector<std::string> required;
  for (const Claim& claim : claims())
    if (claim.definition().required && !claim.definition().withdrawn)
      required.push_back(claim.definition().measure);
  EXPECT_THAT(required, testing::UnorderedElementsAre("figure4.largest_mean_position_error_mm_source",
                                                      "figure4.largest_mean_position_error_mm_recorded",
                                                      "figure4.ordered_pairs_source"));
}

TEST(Claims, FiguresFiveAndSixAreAtMostThePaperPrintedMeans) {
  const auto expect = [](const std::string& measure, double printed) {
    const Claim* claim = find_claim(measure);
    ASSERT_NE(claim, nullptr) << measure;
    EXPECT_EQ(claim->definition().rule, (Rule{.kind = Rule::Kind::at_most, .high = printed})) << measure;
  };
  const PaperNumbers& paper = paper_numbers();
  for (const auto& [figure, mean] : {std::pair{"figure5", paper.figure_5.mean}, {"figure6", paper.figure_6.mean}}) {
    expect(std::string(figure) + ".position_error_mm", mean.position_mm);
    expect(std::string(figure) + ".posture_error_deg", mean.posture_deg);
    expect(std::string(figure) + ".rotation_error_deg", mean.rotation_deg);
  }
  const Claim* position = find_claim("figure4.largest_mean_position_error_mm_source");
  EXPECT_EQ(position->definition().rule.high, paper.mean_position_error_below_mm);
  for (const char* measure : {"frame.p95_ms_20_postures", "frame.p95_ms_20_postures_plain"}) {
    const Claim* rate = find_claim(measure);
    ASSERT_NE(rate, nullptr) << measure;
    EXPECT_NEAR(rate->definition().rule.high, 1000 / paper.rate_hz, 0.05) << "one decimal of 66.67 ms";
  }
}

TEST(Claims, OtherMovementsMethodsAndMachinesShowConsistencyOnly) {
  std::vector<std::string> ids;
  for (const Claim& claim : claims())
    if (claim.definition().kind == ClaimKind::consistency) ids.push_back(claim.id);
  EXPECT_THAT(ids, testing::UnorderedElementsAre("figure-5-position", "figure-5-posture", "figure-5-rotation",
                                                 "figure-6-position", "figure-6-posture", "figure-6-rotation",
                                                 "posture-lags", "15-hz", "15-hz-plain", "monocular-depth-error"));
}

TEST(Claims, EachQuotesTheSentenceItJudges) {
  std::vector<std::string> ours;
  for (const Claim& claim : claims()) {
    EXPECT_GT(claim.definition().quote.size(), 40U) << claim.id;
    if (claim.definition().ours) ours.push_back(claim.id);
  }
  EXPECT_THAT(ours, testing::UnorderedElementsAre("lag-is-the-filter", "small-images-are-cheaper",
                                                  "small-images-rank-worse", "interpolation-of-distinct-postures"));
}

TEST(Claims, NoTrifleSatisfiesARule) {
  for (const Claim& claim : claims()) {
    const Rule& rule = claim.definition().rule;
    EXPECT_NE(rule.low, 0) << claim.id << ": a difference of next to nothing would do";
    const bool is_ratio = claim.definition().measure.ends_with("_share") && rule.low < 0;
    if (is_ratio) {
      EXPECT_LT(rule.high, 0.9) << claim.id << ": times of one machine differ by 8%";
    }
  }
}

TEST(Claims, MinimumEffectsAreHalfOfWhatThePaperPrints) {
  const auto rule = [](const char* measure) { return find_claim(measure)->definition().rule; };
  const auto printed = [](size_t row) { return paper_numbers().figure_8.at(row); };
  const auto& [cascade, large, tiny] = std::tuple{printed(1), printed(2), printed(3)};
  EXPECT_NEAR(rule("figure8.time_share").high, 1 - (1 - cascade.time_ms / large.time_ms) / 2, 0.005);
  EXPECT_NEAR(rule("figure8.tiny_time_share").high, 1 - (1 - tiny.time_ms / cascade.time_ms) / 2, 0.005);
  EXPECT_NEAR(rule("figure8.tiny_posture_excess_deg").low, (tiny.posture_error_deg - large.posture_error_deg) / 2,
              0.01);
  EXPECT_NEAR(rule("interpolation.distinct_excess_deg").low, paper_numbers().figure_5.mean.posture_deg, 0.005);
}

TEST(Claims, ErrorsNameFileFieldAndExpectation) {
  const auto first = [](json& j) -> json& { return j["claims"][0]; };
  const auto set = [](json& j) -> json& { return j["claims"][0]["history"][0]["set"]; };
  EXPECT_EQ(claims_error([](json&) {}), "");
  EXPECT_THAT(claims_error([](json& j) { j["version"] = 2; }), HasSubstr("claims.json: version: found 2"));
  EXPECT_THAT(claims_error([](json& j) { j["extra"] = 2; }), HasSubstr("unknown key \"extra\""));
  EXPECT_THAT(claims_error([&](json& j) { set(j).erase("if_not"); }),
              HasSubstr("claims[0].history[0].set.if_not: found nothing"));
  EXPECT_THAT(claims_error([&](json& j) { first(j)["rule"] = set(j)["rule"]; }), HasSubstr("unknown key \"rule\""));
  EXPECT_THAT(claims_error([&](json& j) { j["claims"][1]["id"] = first(j)["id"]; }),
              HasSubstr("claims[1].id: found \"position-below-1-cm-recorded\", expected each id once"));
  EXPECT_THAT(claims_error([&](json& j) { first(j)["id"] = "Two Words"; }), HasSubstr("claims[0].id"));
  EXPECT_THAT(claims_error([&](json& j) { set(j)["claim"] = "two\nlines"; }), HasSubstr("a line of text"));
  EXPECT_THAT(claims_error([&](json& j) { set(j)["measure"] = ""; }),
              HasSubstr("claims[0].history[0].set.measure"));
  EXPECT_THAT(claims_error([&](json& j) { set(j)["kind"] = "guess"; }),
              HasSubstr("claims[0].history[0].set.kind: found \"guess\", expected reproduction or consistency"));
  EXPECT_THAT(claims_error([&](json& j) { set(j)["required"] = 1; }), HasSubstr("true or false"));
}

TEST(Claims, ErrorsInRules) {
  const auto error_of_rule = [](const json& rule) {
    return claims_error([&](json& j) { j["claims"][0]["history"][0]["set"]["rule"] = rule; });
  };
  EXPECT_EQ(error_of_rule({{"within", {-1, 1}}}), "");
  EXPECT_THAT(error_of_rule(json::object()),
              HasSubstr("claims[0].history[0].set.rule: found an object, expected an object with one"));
  EXPECT_THAT(error_of_rule({{"below", 1}, {"above", 0}}), HasSubstr("with one rule"));
  EXPECT_THAT(error_of_rule({{"near", 1}}), HasSubstr("expected below, at_most, above, at_least or within"));
  EXPECT_THAT(error_of_rule({{"below", "1"}}), HasSubstr("claims[0].history[0].set.rule.below"));
  EXPECT_THAT(error_of_rule({{"below", 1e7}}), HasSubstr("claims[0].history[0].set.rule.below"));
  EXPECT_THAT(error_of_rule({{"within", {1}}}), HasSubstr("the lower and the upper bound"));
  EXPECT_THAT(error_of_rule({{"within", {2, 1}}}), HasSubstr("claims[0].history[0].set.rule.within[1]"));
}

TEST(Claims, DamageGivesAnErrorOrClaimsButNothingElse) {
  const std::string text = embedded_claims();
  int refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    RandomStream random(21, "claims_test", trial, "damage");
    try {
      for (const Claim& claim : parse_claims(damaged_text(text, random), "claims.json").claims)
        EXPECT_FALSE(to_string(claim.definition().rule).empty());
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  // Most of the file is sentences, in which a changed letter is still a valid sentence.
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace glovebench::reports
