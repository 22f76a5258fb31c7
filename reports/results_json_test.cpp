#include "reports/results_json.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "core/base/damaged_text.h"
#include "core/base/error.h"
#include "core/test_folder.h"
#include "reports/commands.h"
#include "reports/example_result.h"
#include "reports/test_text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string error_of(const std::string& text) {
  return thrown_by([&] { parse_results(text, "results.json"); });
}

std::string error_of_change(const std::function<void(json&)>& change) {
  json results = json::parse(results_json(small_result()));
  change(results);
  return error_of(results.dump());
}

TEST(ResultsJson, RoundTrip) {
  const std::string path = test_folder() + "/results.json";
  const RunResult result = small_result();
  write_results(path, result);
  const RunResult read = read_results(path);
  EXPECT_EQ(results_json(read), results_json(result));
  EXPECT_EQ(read.protocol, result.protocol);
  EXPECT_EQ(read.configuration, result.configuration);
  // The example has only short decimals, which rounding keeps.
  EXPECT_EQ(read.experiments[0].runs, result.experiments[0].runs);
  EXPECT_EQ(read.experiments[0].sequence, result.experiments[0].sequence);
  EXPECT_EQ(read.experiments[1], result.experiments[1]);
  EXPECT_EQ(read.experiments[2], result.experiments[2]);
}

TEST(ResultsJson, EqualResultsAreEqualBytes) {
  EXPECT_EQ(results_json(full_result()), results_json(full_result()));
}

TEST(ResultsJson, OnlyABareHandHasAnAppearance) {
  RunResult result = small_result();
  EXPECT_THAT(results_json(result), Not(HasSubstr("appearance")));
  result.experiments[0].key.appearance = Appearance::skin;
  const std::string text = results_json(result);
  EXPECT_EQ(parse_results(text, "results.json").experiments[0].key, result.experiments[0].key);
  EXPECT_THAT(to_string(result.experiments[0].key), HasSubstr("_subject1-skin_"));
  EXPECT_THAT(error_of_change([](json& json) { json["experiments"][0]["appearance"] = "fur"; }),
              testing::AllOf(HasSubstr("appearance"), HasSubstr("fur"), HasSubstr("glove or skin")));
}

TEST(ResultsJson, StudiesAreThereOnlyIfThereAreAny) {
  RunResult result = small_result();
  const std::string without = results_json(result);
  EXPECT_THAT(without, Not(HasSubstr("studies")));
  EXPECT_TRUE(parse_results(without, "results.json").studies.empty());
  result.studies = example_studies();
  const std::string with = results_json(result);
  const std::string common = without.substr(0, without.rfind("\n}"));
  EXPECT_THAT(with, testing::StartsWith(common + ",\n \"studies\": ")) << "the rest stays as it was";
  EXPECT_THAT(with, Not(HasSubstr("look_up_ms"))) << "times differ from run to run";
  EXPECT_THAT(with, Not(HasSubstr("time_share")));
  const RunResult read = parse_results(with, "results.json");
  ASSERT_EQ(read.studies.size(), 2u);
  EXPECT_EQ(results_json(read), with);
}

TEST(ResultsJson, CommandsAreThereOnlyIfThereAreAny) {
  const RunResult result = small_result();
  const json results = json::parse(results_json(result));
  EXPECT_EQ(results["experiments"][0]["commands"]["interventions"], (json{{"arm_speed", 1}, {"hold", 2}}));
  EXPECT_FALSE(results["experiments"][1].contains("commands"));
  const RunResult read = parse_results(results_json(result), "results.json");
  ASSERT_TRUE(read.experiments[0].commands.has_value());
  EXPECT_EQ(read.experiments[0].commands->sent, result.experiments[0].commands->sent);
  EXPECT_EQ(read.experiments[0].commands->interventions, result.experiments[0].commands->interventions);
  EXPECT_EQ(commands_json(*read.experiments[0].commands), commands_json(*result.experiments[0].commands));
  EXPECT_FALSE(read.experiments[1].commands.has_value());
}

TEST(ResultsJson, CommandsThatNoRunHas) {
  const auto error_of_commands = [](const std::function<void(json&)>& change) {
    return error_of_change([&](json& r) { change(r["experiments"][0]["commands"]); });
  };
  EXPECT_THAT(error_of_commands([](json& c) { c["frames"] = 5; }),
              HasSubstr("commands.frames: found 5, expected the frames in runs"));
  EXPECT_THAT(error_of_commands([](json& c) { c["sent"]["stopped"] = 1; }),
              HasSubstr("commands.sent: found an object, expected no more commands than frames"));
  EXPECT_THAT(error_of_commands([](json& c) { c["sent"]["following"] = 2147483647; }),
              HasSubstr("expected no more commands than frames"));
  EXPECT_THAT(error_of_commands([](json& c) { c["interventions"]["panic"] = 1; }),
              HasSubstr("commands.interventions.panic: found 1, expected a known intervention"));
  EXPECT_THAT(error_of_commands([](json& c) { c["interventions"]["hold"] = 0; }), HasSubstr("interventions.hold"));
  EXPECT_THAT(error_of_commands([](json& c) { c["errors"].erase("arm_deg"); }), HasSubstr("commands.errors"));
  EXPECT_THAT(error_of_commands([](json& c) { c["errors"]["joints_deg"]["count"] = 3; }),
              HasSubstr("errors.joints_deg.count: found 3, expected no more than the commands that follow"));
  EXPECT_THAT(error_of_commands([](json& c) { c["jerk"]["joints_deg_s3"] = -1; }), HasSubstr("jerk.joints_deg_s3"));
  EXPECT_THAT(error_of_commands([](json& c) { c["rate_hz"] = "often"; }), HasSubstr("commands.rate_hz"));
  EXPECT_THAT(error_of_commands([](json& c) { c.erase("truth_jerk"); }), HasSubstr("commands.truth_jerk"));
}

TEST(ResultsJson, NoValueIsNull) {
  const json results = json::parse(results_json(small_result()));
  const json& lost = results["experiments"][1];
  EXPECT_TRUE(lost["aggregates"]["position_error_mm"]["mean"].is_null());
  EXPECT_EQ(lost["aggregates"]["position_error_mm"]["count"], 0);
  EXPECT_TRUE(lost["runs"][0]["frames"][0][9].is_null());
  EXPECT_EQ(lost["coverage"]["share"], 0);
  EXPECT_TRUE(results["experiments"][2]["coverage"]["share"].is_null());
}

TEST(ResultsJson, MetricsOfAnotherVersion) {
  json results = json::parse(results_json(small_result()));
  add_metric(results, "mood_deg");
  remove_metric(results, "rotation_error_deg");
  const RunResult read = parse_results(results.dump(), "results.json");
  EXPECT_EQ(read.protocol.id(), results["protocol"]["id"]);
  const FrameRecord& frame = read.experiments[0].runs[0].frames[0];
  EXPECT_EQ(frame["position_error_mm"], 3) << "columns are found by name";
  EXPECT_EQ(frame["posture_rms_deg"], 2);
  EXPECT_EQ(frame["rotation_error_deg"], std::nullopt);
  EXPECT_EQ(read.experiments[0].aggregate_of("rotation_error_deg"), Aggregate{});

  const json written = json::parse(results_json(read));
  EXPECT_EQ(written["frame_columns"].size(), frame_metrics().size() - 1 + 9) << "no mood, no rotation";
  EXPECT_EQ(results_json(parse_results(written.dump(), "again")), results_json(read));

  add_metric(results, "position_error_mm");
  EXPECT_THAT(error_of(results.dump()), HasSubstr("each metric once"));
}

/// As a program wrote it that knew no levels of coverage.
json older_results() {
  json results = json::parse(results_json(small_result()));
  results["protocol"].erase("coverage_rules");
  remove_metric(results, "visible_percent");
  for (json& experiment : results["experiments"]) {
    for (const char* key : {"visible", "found", "usable", "found_share", "usable_share"})
      experiment["coverage"].erase(key);
    experiment.erase("fingertip_pck");
  }
  return results;
}

TEST(ResultsJson, OlderResultsHaveNoLevelsOfCoverage) {
  const json older = older_results();
  const RunResult read = parse_results(older.dump(), "results.json");
  EXPECT_EQ(read.experiments[0].coverage, (Coverage{4, 3, 1, 0, 1, 0, 0, 0}));
  EXPECT_FALSE(read.experiments[0].coverage.found_share());
  EXPECT_FALSE(read.experiments[0].fingertip_pck);
  EXPECT_EQ(read.protocol.id(), older["protocol"]["id"]);
  EXPECT_EQ(json::parse(results_json(read)), older) << "nothing is invented when it is written again";
}

TEST(ResultsJson, SharesThatWereCountedByOtherRulesAreNotComparable) {
  json results = json::parse(results_json(small_result()));
  results["protocol"]["coverage_rules"]["usable_position_mm"] = 12;
  renew_protocol_id(results["protocol"]);
  EXPECT_EQ(thrown_by<Incomparable>([&] { parse_results(results.dump(), "results.json"); }),
            "results.json: protocol.coverage_rules.usable_position_mm: found 12, expected 10");
  EXPECT_THAT(error_of_change([](json& r) { r["protocol"]["coverage_rules"]["mood"] = 1; }),
              HasSubstr("coverage_rules.mood: found 1, expected a rule that this program knows"));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["coverage"]["usable"] = 2; }),
              HasSubstr("coverage: found an object, expected the counts of the frames"));
}

TEST(ResultsJson, FingertipsHaveTheirOwnCurve) {
  const json results = json::parse(results_json(small_result()));
  EXPECT_EQ(results["experiments"][0]["fingertip_pck"]["shares"].size(), 51u);
  EXPECT_FALSE(results["experiments"][1].contains("fingertip_pck"));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["fingertip_pck"]["shares"].erase(3); }),
              HasSubstr("fingertip_pck.shares: found an array of 50, expected one for each threshold"));
}

TEST(ResultsJson, ColumnsAndAggregatesAreThoseOfTheProtocol) {
  EXPECT_THAT(error_of_change([](json& r) { std::swap(r["frame_columns"][9], r["frame_columns"][10]); }),
              HasSubstr("frame_columns: found an array"));
  EXPECT_THAT(error_of_change([](json& r) { r["frame_columns"].push_back("mood_deg"); }),
              HasSubstr("frame_columns: found an array"));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["runs"][0]["frames"][0].push_back(1); }),
              HasSubstr("frames[0]: found an array"));
  EXPECT_THAT(error_of_change([](json& r) {
                json& aggregates = r["experiments"][0]["aggregates"];
                aggregates["mood_deg"] = aggregates["position_error_mm"];
              }),
              HasSubstr("aggregates: found an object"));
}

TEST(ResultsJson, NothingThatIsNotFiniteIsWritten) {
  RunResult result = small_result();
  result.experiments[0].runs[0].frames[0]["position_error_mm"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(results_json(result), std::logic_error);
}

TEST(ResultsJson, NumbersAreRoundedOnce) {
  EXPECT_EQ(format_json({rounded(1.0 / 3), rounded(-1e-9), rounded(4)}), "[0.333333,0.0,4.0]\n");
  EXPECT_EQ(format_json({{"a", {1, 2}}, {"b", {{"c", nullptr}}}}),
            "{\n \"a\": [1,2],\n \"b\": {\n  \"c\": null\n }\n}\n");
}

TEST(ResultsJson, ErrorsNameFileFieldAndExpectation) {
  EXPECT_THAT(error_of("{\"format\": "), HasSubstr("results.json: column 12: found the end"));
  EXPECT_THAT(error_of("[]"), HasSubstr("top level: found an array of 0, expected an object"));
  EXPECT_THAT(error_of("{}"), HasSubstr("format: found nothing"));
  EXPECT_THAT(error_of_change([](json& r) { r["version"] = 1; }), HasSubstr("version: found 1, expected"));
  EXPECT_THAT(error_of_change([](json& r) { r["protocol"]["association"] = "nearest"; }), HasSubstr("protocol.id"));
  EXPECT_THAT(error_of_change([](json& r) { r["mood"] = "good"; }), HasSubstr("unknown key \"mood\""));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0].erase("runs"); }),
              HasSubstr("experiments[0].runs: found nothing"));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["runs"][1]["frames"][0][2] = "lucky"; }),
              HasSubstr("experiments[0].runs[1].frames[0][2]: found \"lucky\", expected tracked, no_hand, "));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["runs"][0]["frames"][0].erase(9); }),
              HasSubstr(fmt::format("frames[0]: found an array of {}", 9 + frame_metrics().size() - 1)));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["coverage"]["lost"] = 0; }),
              HasSubstr("experiments[0].coverage"));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["runs"][0]["frames"].erase(1); }),
              HasSubstr("experiments[0].runs[1].frames: found an array of 2, expected an array of 1"));
  EXPECT_THAT(error_of_change([](json& r) { r["experiments"][0]["aggregates"].erase("position_error_mm"); }),
              HasSubstr("experiments[0].aggregates"));
}

TEST(ResultsJson, AFramesStatusCoverAndErrorsAgree) {
  constexpr int kStatus = 2, kCovered = 3, kFalseTracked = 4, kFalseLost = 5, kFirst = 9;
  const auto error_of_frame = [](int frame, const std::function<void(json&)>& change) {
    return error_of_change([&](json& r) { change(r["experiments"][0]["runs"][0]["frames"][frame]); });
  };
  for (const Metric& metric : frame_metrics()) {
    const size_t column = kFirst + metric_index(metric.key);
    const std::string field = "frames[0][" + std::to_string(column) + "]";
    if (!metric.of_tracked) continue;
    if (!metric.is_partial) {
      EXPECT_THAT(error_of_frame(0, [&](json& f) { f[column] = nullptr; }),
                  HasSubstr(field + ": found null, expected a number, since the frame is tracked"));
    }
    EXPECT_THAT(error_of_frame(1, [&](json& f) { f[column] = 1; }),
                HasSubstr("found 1, expected null, since the frame is lost"));
  }
  EXPECT_THAT(error_of_frame(0, [](json& f) { f[kCovered] = false; }), HasSubstr("frames[0][3]: found false"));
  EXPECT_THAT(error_of_frame(0, [](json& f) { f[kFirst] = 50.1; }),
              HasSubstr("frames[0][3]: found true, expected false, as the errors say"));
  EXPECT_THAT(error_of_frame(0, [](json& f) { f[kFirst + 1] = 30.1; }), HasSubstr("frames[0][3]: found true"));
  EXPECT_THAT(error_of_frame(1, [](json& f) { f[kCovered] = true; }), HasSubstr("frames[1][3]: found true"));
  EXPECT_THAT(error_of_frame(0, [](json& f) { f[kFalseTracked] = true; }), HasSubstr("frames[0][4]: found true"));
  EXPECT_THAT(error_of_frame(1, [](json& f) { f[kFalseTracked] = true; }), HasSubstr("frames[1][4]: found true"));
  EXPECT_THAT(error_of_frame(0, [](json& f) { f[kFalseLost] = true; }), HasSubstr("frames[0][5]: found true"));
  EXPECT_THAT(error_of_frame(0, [](json& f) { f[kStatus] = "no_hand"; }), HasSubstr("since the frame is lost"));
}

TEST(ResultsJson, ErrorsThatAreRoundedToTheBoundOfCoverageAreRead) {
  for (const double error_mm : {49.9999999, 50.0, 50.0000001}) {
    RunResult result = small_result();
    const SeedRun run = {1, {example_frame(0, error_mm, 2, 1)}};
    result.experiments = {
        summarize({"Tr4", "DB_open_power", TruthKind::recorded, 1, {}}, {run}, pck_curve({}, 1), {})};
    EXPECT_EQ(error_of(results_json(result)), "") << error_mm;
  }
}

TEST(ResultsJson, MissingFileIsAnError) {
  EXPECT_THROW(read_results(test_folder() + "/no_such_results.json"), Error);
}

TEST(ResultsJson, DamageGivesAnErrorOrAReadableResultButNothingElse) {
  const std::string text = results_json(small_result());
  int refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    RandomStream random(20, "results_json_test", trial, "damage");
    try {
      // An accepted change, e.g. another digit, gives valid results that can be written again.
      EXPECT_FALSE(results_json(parse_results(damaged_text(text, random), "results.json")).empty());
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 350) << "most damage breaks the syntax, a key or a count";
}

}  // namespace
}  // namespace glovebench::reports
