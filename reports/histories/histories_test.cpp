#include "reports/histories/histories.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

constexpr const char* kFirst = "Tr4_DB_open_power_recorded_subject1_gradient_1";
constexpr const char* kLost = "Tr4_DB_open_power_source_subject2_gradient_1";
constexpr const char* kEmpty = "Tr1_DB_20_postures_source_subject1_gradient_1";

TEST(Bencher, ValuesWithTheirIntervals) {
  const RunResult result = full_result();
  const nlohmann::json json = nlohmann::json::parse(bencher_json(result));
  ASSERT_EQ(json.size(), result.experiments.size());
  const ExperimentResult& experiment = result.experiments[3];
  const nlohmann::json& measures = json[to_string(experiment.key)];
  EXPECT_EQ(measures.size(), gated_metrics().size());
  const nlohmann::json& position = measures["position_error_mm"];
  const auto& interval = experiment.interval_of("position_error_mm");
  EXPECT_NEAR(position["value"].get<double>(), *experiment.aggregate_of("position_error_mm").mean, 1e-6);
  EXPECT_NEAR(position["lower_value"].get<double>(), interval->low, 1e-6);
  EXPECT_NEAR(position["upper_value"].get<double>(), interval->high, 1e-6);
}

TEST(Bencher, SharesAreOfAllFramesAndHaveNoInterval) {
  const nlohmann::json json = nlohmann::json::parse(bencher_json(small_result()));
  EXPECT_EQ(json[kFirst]["position_error_mm"]["value"], 4.0);
  EXPECT_EQ(json[kFirst]["uncovered_percent"], nlohmann::json({{"value", 25.0}}));
  EXPECT_EQ(json[kFirst]["false_tracked_percent"]["value"], 0.0);
  EXPECT_EQ(json[kFirst]["false_lost_percent"]["value"], 25.0);
}

TEST(Bencher, WhatHasNoValueIsLeftOut) {
  const nlohmann::json json = nlohmann::json::parse(bencher_json(small_result()));
  EXPECT_EQ(json[kLost].size(), 3u) << "lost frames have no errors, but shares";
  EXPECT_FALSE(json.contains(kEmpty)) << "no frames at all";
  EXPECT_EQ(nlohmann::json::parse(bencher_json({})), nlohmann::json::object());
}

TEST(GithubActionBenchmark, AnEntryForEachGatedMetric) {
  const RunResult result = full_result();
  const nlohmann::json json = nlohmann::json::parse(github_action_benchmark_json(result));
  ASSERT_EQ(json.size(), result.experiments.size() * gated_metrics().size());
  const nlohmann::json& position = json[0];
  EXPECT_EQ(position["name"], to_string(result.experiments[0].key) + " position_error_mm");
  EXPECT_EQ(position["unit"], "mm");
  const auto& interval = result.experiments[0].interval_of("position_error_mm");
  const double mean = *result.experiments[0].aggregate_of("position_error_mm").mean;
  ASSERT_THAT(position["range"].get<std::string>(), testing::StartsWith("± "));
  const double range = std::stod(position["range"].get<std::string>().substr(3));
  EXPECT_LE(mean - range, interval->low + 0.001);
  EXPECT_GE(mean + range, interval->high - 0.001);
  EXPECT_THAT(position["extra"].get<std::string>(), testing::HasSubstr("95% interval"));
}

TEST(GithubActionBenchmark, WhatHasNoValueIsLeftOut) {
  const nlohmann::json json = nlohmann::json::parse(github_action_benchmark_json(small_result()));
  for (const nlohmann::json& entry : json) {
    EXPECT_TRUE(entry["value"].is_number());
    EXPECT_THAT(entry["name"].get<std::string>(), testing::Not(testing::StartsWith(kEmpty)));
  }
  EXPECT_EQ(nlohmann::json::parse(github_action_benchmark_json({})), nlohmann::json::array());
}

}  // namespace
}  // namespace glovebench::reports
