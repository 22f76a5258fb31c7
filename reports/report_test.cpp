#include "reports/report.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/example_result.h"
#include "reports/results_json.h"

namespace glovebench::reports {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string fresh_folder(const std::string& name) { return test_folder() + "/" + name; }

Timings example_timings() {
  Timings timings;
  timings.host = "bench";
  timings.date = "2026-01-01T00:00:00Z";
  timings.wall_s = 1.5;
  timings.peak_memory_mb = 512;
  timings.experiments = {
      {small_result().experiments[0].key, 1.25, {{"align", {1, 2, 3}}, {"look_up", {}}}, {4, 5, 6, 105}}};
  return timings;
}

std::vector<ExperimentEstimates> example_estimates(const RunResult& result) {
  std::vector<ExperimentEstimates> all;
  for (const ExperimentResult& experiment : result.experiments) {
    all.push_back({experiment.key, {}});
    for (const SeedRun& run : experiment.runs)
      for (const FrameRecord& frame : run.frames)
        all.back().estimates.push_back({run.seed, frame.frame, frame.timestamp_us, frame.status});
  }
  return all;
}

TEST(Report, WritesEveryFile) {
  const std::string folder = fresh_folder("files");
  const RunResult result = small_result();
  const std::vector<std::string> names =
      write_report(folder, result, example_timings(), {}, example_estimates(result));
  std::vector<std::string> expected = {"config.json",
                                       "summary.md",
                                       "index.html",
                                       "timings.json",
                                       "histories/bencher.json",
                                       "histories/github_action_benchmark.json",
                                       "tables/figure4.tex",
                                       "tables/figure4.csv",
                                       "tables/figure5.csv"};
  const std::vector<std::string> experiments = {
      "Tr4_DB_open_power_recorded_subject1_gradient_1", "Tr4_DB_open_power_source_subject2_gradient_1",
      "Tr1_DB_20_postures_source_subject1_gradient_1", "Tr4_DB_open_power_recorded_subject1_kinect_0.5"};
  for (const std::string& name : experiments) expected.push_back("tables/frames_" + name + ".csv");
  expected.push_back("tables/metrics.csv");
  expected.push_back("tables/commands.csv");
  expected.push_back("claims.json");
  expected.push_back("tables/claims.csv");
  for (const std::string& name : experiments) expected.push_back("estimates/" + name + ".csv");
  expected.push_back("results.json");
  EXPECT_THAT(names, testing::ElementsAreArray(expected)) << "the results last";
  for (const std::string& name : names) EXPECT_GT(fs::file_size(folder + "/" + name), 0u) << name;
  EXPECT_EQ(results_json(read_results(folder + "/results.json")), results_json(small_result()));
  EXPECT_EQ(nlohmann::json::parse(read_file(folder + "/config.json")), small_result().configuration);
}

TEST(Report, WritesWhatStudiesFound) {
  const std::string folder = fresh_folder("studies");
  const std::vector<std::string> names = write_report(folder, full_result(), example_timings());
  EXPECT_THAT(names, testing::IsSupersetOf({"tables/figure7.csv", "tables/figure8.csv"}));
  EXPECT_EQ(names.back(), "results.json");
  const std::string summary = read_file(folder + "/summary.md");
  EXPECT_LT(summary.find("## Claims"), summary.find("## Figure 4"));
  EXPECT_LT(summary.find("## Figure 8: matching cascades"), summary.find("## More metrics"));
  EXPECT_THAT(read_file(folder + "/index.html"), HasSubstr("<h2>Claims</h2>"));
  const nlohmann::json timings = nlohmann::json::parse(read_file(folder + "/timings.json"));
  EXPECT_EQ(timings["studies"][0]["measures"][0]["name"], "figure7.steps_with_higher_time");
  EXPECT_FALSE(nlohmann::json::parse(timings_json(example_timings())).contains("studies"));
}

TEST(Report, TimesOfStudiesLeaveTheResultsAsTheyAre) {
  RunResult slower = full_result();
  slower.studies[1].tables[0].rows[0][column_index(slower.studies[1].tables[0], "frame_ms_p50")] = 1e4;
  slower.studies[1].measures[1].value = 2;  // a share of times
  EXPECT_EQ(results_json(slower), results_json(full_result()));
  EXPECT_NE(timings_json({}, slower.studies), timings_json({}, full_result().studies));
}

TEST(Report, RemovesTablesOfAnOlderReportsStudies) {
  const std::string folder = fresh_folder("stale_studies");
  write_report(folder, full_result(), {});
  write_file(folder + "/tables/mine.csv", "the user's");
  RunResult fewer = full_result();
  fewer.studies.pop_back();
  fewer.experiments.clear();
  write_report(folder, fewer, {});
  EXPECT_FALSE(fs::exists(folder + "/tables/figure8.csv"));
  EXPECT_TRUE(fs::exists(folder + "/tables/figure7.csv"));
  EXPECT_TRUE(fs::exists(folder + "/tables/mine.csv"));
  EXPECT_TRUE(fs::exists(folder + "/claims.json"));
  fewer.studies.clear();
  write_report(folder, fewer, {});
  EXPECT_FALSE(fs::exists(folder + "/tables/figure7.csv"));
  EXPECT_FALSE(fs::exists(folder + "/claims.json"));
  EXPECT_FALSE(fs::exists(folder + "/tables/claims.csv"));
  EXPECT_TRUE(fs::exists(folder + "/tables/mine.csv"));
}

TEST(Report, OnlyTimingsAndTheLatencyOfCommandsDifferBetweenRuns) {
  Timings slower = example_timings();
  slower.wall_s = 99;
  RunResult result = full_result();
  result.studies.clear();
  const std::string first = fresh_folder("first"), second = fresh_folder("second"), third = fresh_folder("third");
  const std::vector<std::string> names = write_report(first, result, example_timings());
  ASSERT_EQ(write_report(second, result, slower), names);
  for (const std::string& name : names)
    EXPECT_EQ(read_file(first + "/" + name) == read_file(second + "/" + name), name != "timings.json") << name;
  slower.experiments[0].command_ms = {77};
  ASSERT_EQ(write_report(third, result, slower), names);
  for (const std::string& name : names)
    EXPECT_EQ(read_file(first + "/" + name) == read_file(third + "/" + name),
              name != "timings.json" && name != "index.html")
        << name;
}

TEST(Report, RemovesWhatAnOlderReportLeftAndNothingElse) {
  const std::string folder = fresh_folder("stale");
  const RunResult all = small_result();
  write_report(folder, all, example_timings(), {}, example_estimates(all));
  const std::string experiment = "Tr4_DB_open_power_recorded_subject1_kinect_0.5.csv";
  const std::vector<std::string> of_the_user = {"notes.md",
                                                "tables/mine.csv",
                                                "tables/frames_mine.csv",
                                                "tables/frames_" + experiment + ".bak",
                                                "tables/old/frames_" + experiment,
                                                "tables/notes.csv.tmp-1-0",
                                                "estimates/filtered.csv",
                                                experiment};
  for (const std::string& name : of_the_user) write_file(folder + "/" + name, "the user's");
  write_file(folder + "/.staged/tables/frames_" + experiment, "half");  // left by a killed writer

  RunResult fewer = all;
  fewer.experiments.erase(fewer.experiments.begin() + 1, fewer.experiments.end());
  fewer.experiments[0].key.trajectory = "Tr5";  // no Figure 5 either
  const std::vector<std::string> names =
      write_report(folder, fewer, example_timings(), {}, example_estimates(fewer));
  std::vector<std::string> expected = names, found;
  expected.emplace_back("manifest.json");
  expected.insert(expected.end(), of_the_user.begin(), of_the_user.end());
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) found.push_back(fs::relative(entry.path(), folder).string());
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
}

TEST(Report, FolderThatCannotBeWrittenIsAnError) {
  const std::string blocked = fresh_folder("blocked");
  write_file(blocked, "a file, not a folder");
  EXPECT_THROW(write_report(blocked, small_result(), {}), Error);
}

TEST(Timings, StagesWithoutFramesAreNull) {
  const nlohmann::json json = nlohmann::json::parse(timings_json(example_timings()));
  const nlohmann::json& experiment = json["experiments"][0];
  EXPECT_EQ(experiment["experiment"], "Tr4_DB_open_power_recorded_subject1_gradient_1");
  EXPECT_EQ(json["peak_memory_mb"], 512);
  EXPECT_EQ(experiment["stages"]["align"]["median_ms"], 2);
  EXPECT_DOUBLE_EQ(experiment["stages"]["align"]["p95_ms"].get<double>(), 2.9);
  EXPECT_EQ(experiment["stages"]["look_up"]["count"], 0);
  EXPECT_TRUE(experiment["stages"]["look_up"]["mean_ms"].is_null());
}

TEST(Timings, HaveThe99thPercentileFromFrameToCommand) {
  Timings timings = example_timings();
  const auto latency = [&] { return nlohmann::json::parse(timings_json(timings))["experiments"][0]; };
  EXPECT_EQ(latency()["frame_to_command"]["count"], 4);
  EXPECT_EQ(latency()["frame_to_command"]["median_ms"], 5.5);
  EXPECT_DOUBLE_EQ(latency()["frame_to_command"]["p99_ms"].get<double>(), 102.03);
  EXPECT_EQ(latency()["frame_to_command"]["max_ms"], 105);
  timings.experiments[0].command_ms.clear();
  EXPECT_FALSE(latency().contains("frame_to_command"));
}

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
  EXPECT_EQ(json[kLost].size(), 4u) << "lost frames have no errors, but shares";
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
