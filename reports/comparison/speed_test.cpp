#include "reports/comparison/speed.h"

#include <gmock/gmock.h>

#include "core/base/damaged_text.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/results.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json repetition(const std::string& name, int index, double cpu_time, const std::string& unit = "ms") {
  return {{"name", name},    {"run_name", name},          {"run_type", "iteration"}, {"repetition_index", index},
          {"iterations", 6}, {"real_time", 3 * cpu_time}, {"cpu_time", cpu_time},    {"time_unit", unit},
          {"frame", 1e-3}};
}

json aggregate(const std::string& name, const std::string& kind, double cpu_time, const std::string& unit = "ms") {
  json run = repetition(name, 0, cpu_time, unit);
  run.erase("repetition_index");
  run["name"] = name + "_" + kind;
  run["run_type"] = "aggregate";
  run["aggregate_name"] = kind;
  return run;
}

/// As Google Benchmark writes it: two pairs, one benchmark without a partner, aggregates after the repetitions.
json benchmark_file() {
  json runs = json::array();
  for (const double ms : {12.0, 30.0, 15.0}) runs.push_back(repetition("search/plain", runs.size(), ms));
  runs.push_back(aggregate("search/plain", "mean", 19));
  runs.push_back(aggregate("search/plain", "median", 15));
  runs.push_back(aggregate("search/plain", "cv", 0.5, "ms"));
  int index = 0;
  for (const double us : {4000.0, 5000.0, 6000.0}) runs.push_back(repetition("search/fast", index++, us, "us"));
  runs.push_back(aggregate("search/fast", "median", 1, "us"));
  index = 0;
  for (const double ms : {8.0, 2.0, 4.0, 6.0}) runs.push_back(repetition("a/b/plain", index++, ms));
  index = 0;
  for (const double ns : {2e6, 2e6, 2e6, 2e6}) runs.push_back(repetition("a/b/fast", index++, ns, "ns"));
  runs.push_back(repetition("frame/track", 0, 1, "s"));
  return {{"context", {{"host_name", "somewhere"}, {"num_cpus", 2}}}, {"benchmarks", runs}};
}

std::vector<SpeedRatio> parsed(const json& file) { return parse_speed_ratios(file.dump(), "bench.json"); }

std::string speed_error(const std::string& text) {
  return thrown_by([&] { parse_speed_ratios(text, "bench.json"); });
}

template <typename Change>
std::string speed_error_of_change(Change change) {
  json file = benchmark_file();
  change(file["benchmarks"]);
  return speed_error(file.dump());
}

TEST(SpeedRatios, are_of_the_medians_of_cpu_times_whatever_their_units) {
  const std::vector<SpeedRatio> ratios = parsed(benchmark_file());
  ASSERT_EQ(ratios.size(), 2u);
  EXPECT_EQ(ratios[0].name, "a/b");
  EXPECT_DOUBLE_EQ(ratios[0].ratio, 2.5);  // the median of four is the mean of 4 and 6 ms
  EXPECT_DOUBLE_EQ(ratios[0].low, 2);      // of 1, 2, 3, 4
  EXPECT_DOUBLE_EQ(ratios[0].high, 3);
  EXPECT_EQ(ratios[1].name, "search");
  EXPECT_DOUBLE_EQ(ratios[1].ratio, 3);  // 15 / 5, not 19 / 5, and not the aggregates'
  EXPECT_DOUBLE_EQ(ratios[1].low, 3);    // of 15 / 6, 12 / 4 and 30 / 5
  EXPECT_DOUBLE_EQ(ratios[1].high, 3);
}

TEST(SpeedRatios, do_not_depend_on_aggregates_or_the_order_of_runs) {
  json file = benchmark_file();
  json runs = json::array();
  for (const json& run : file["benchmarks"])
    if (run["run_type"] == "iteration") runs.insert(runs.begin(), run);
  EXPECT_EQ(parsed({{"benchmarks", runs}}), parsed(file));
}

TEST(SpeedRatios, need_three_repetitions_of_both) {
  const auto drop = [](const std::string& name, int index) {
    return speed_error_of_change([&](json& runs) {
      for (size_t i = 0; i < runs.size(); ++i)
        if (runs[i]["run_name"] == name && runs[i].value("repetition_index", -1) == index) runs.erase(i--);
    });
  };
  EXPECT_THAT(drop("search/fast", 1), HasSubstr("bench.json: search: found 2 repetitions, expected at least 3"));
  EXPECT_THAT(drop("search/plain", 0), HasSubstr("search: found 2 repetitions"));
  EXPECT_THAT(drop("a/b/plain", 3), HasSubstr("a/b: found 3 and 4 repetitions, expected the same"));
  // --benchmark_report_aggregates_only leaves no repetition at all.
  EXPECT_THAT(speed_error_of_change([](json& runs) {
                for (size_t i = 0; i < runs.size(); ++i)
                  if (runs[i]["run_type"] == "iteration") runs.erase(i--);
              }),
              HasSubstr("found no pair"));
}

TEST(SpeedRatios, refuse_what_is_no_benchmark_file) {
  EXPECT_THAT(speed_error(""), HasSubstr("bench.json: content: found nothing"));
  EXPECT_THAT(speed_error("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(speed_error("{}"), HasSubstr("benchmarks: found nothing"));
  EXPECT_THAT(speed_error("{\"benchmarks\": []}"), HasSubstr("found no pair"));
  EXPECT_THAT(speed_error(std::string(100'000, '[')), HasSubstr("bench.json: nesting"));
  EXPECT_THAT(speed_error_of_change([](json& runs) { runs[0]["time_unit"] = "h"; }),
              HasSubstr("benchmarks[0].time_unit: found \"h\""));
  EXPECT_THAT(speed_error_of_change([](json& runs) { runs[0]["run_type"] = "guess"; }), HasSubstr("run_type"));
  EXPECT_THAT(speed_error_of_change([](json& runs) { runs[1]["repetition_index"] = 0; }),
              HasSubstr("benchmarks[1].repetition_index: found 0, expected each repetition once"));
  EXPECT_THAT(speed_error_of_change([](json& runs) { runs.erase(6); }), HasSubstr("search: found"));
  EXPECT_THAT(speed_error_of_change([](json& runs) { runs[0]["run_name"] = "two\nlines"; }), HasSubstr("run_name"));
  EXPECT_THAT(speed_error_of_change([](json& runs) {
                for (json& run : runs)
                  if (run["run_name"] == "search/fast") run["run_name"] = "search/other";
              }),
              HasSubstr("search: found no search/fast"));
}

TEST(SpeedRatios, refuse_times_that_are_none) {
  for (const json& time : {json(0), json(-1), json(1e300), json(1e-30), json(nullptr), json("1")})
    EXPECT_THAT(speed_error_of_change([&](json& runs) { runs[0]["cpu_time"] = time; }),
                HasSubstr("benchmarks[0].cpu_time: found " + time.dump()))
        << time;
  EXPECT_THAT(speed_error_of_change([](json& runs) { runs[0]["cpu_time"] = 8e7; }),  // 22 hours, against 4 ms
              HasSubstr("search: found ratios of"));
}

TEST(SpeedRatios, refuse_a_benchmark_whose_check_failed) {
  EXPECT_THAT(speed_error_of_change([](json& runs) {
                runs[5]["error_occurred"] = true;
                runs[5]["cpu_time"] = 0;
              }),
              HasSubstr("benchmarks[5].error_occurred: found true"));
}

TEST(SpeedRatios, can_be_kept_without_the_machine) {
  const std::vector<SpeedRatio> ratios = {{"a/b", 2.5, 1, 4}, {"search", 3, 2.5, 6}};
  const std::string text = speed_json(ratios);
  EXPECT_EQ(parse_speed_ratios(text, "speed.json"), ratios);
  EXPECT_EQ(text.find("somewhere"), std::string::npos);
  const TestFolder folder;
  write_file(folder / "speed.json", text);
  EXPECT_EQ(read_speed_ratios(folder / "speed.json"), ratios);
  EXPECT_THROW(read_speed_ratios(folder / "none.json"), Error);
}

TEST(SpeedRatios, refuse_a_kept_file_that_speed_json_does_not_write) {
  const json good = json::parse(speed_json({{"a", 2, 1, 4}, {"b", 3, 2, 6}}));
  const auto error_with = [&](const std::string& pointer, const json& value) {
    json file = good;
    file[json::json_pointer(pointer)] = value;
    return speed_error(file.dump());
  };
  EXPECT_THAT(error_with("/format", "another"), HasSubstr("format: found \"another\""));
  EXPECT_THAT(error_with("/version", 2), HasSubstr("version: found 2"));
  EXPECT_THAT(error_with("/more", 2), HasSubstr("unknown key \"more\""));
  EXPECT_THAT(error_with("/ratios", json::array()), HasSubstr("found no pair"));
  EXPECT_THAT(error_with("/ratios/0/ratio", 5), HasSubstr("ratios[0].ratio: found 5"));
  EXPECT_THAT(error_with("/ratios/0/low", 0), HasSubstr("ratios[0].low: found 0"));
  EXPECT_THAT(error_with("/ratios/0/high", 1e9), HasSubstr("ratios[0].high"));
  EXPECT_THAT(error_with("/ratios/1/name", "a"), HasSubstr("ratios[1].name: found \"a\""));
}

TEST(CompareSpeed, calls_slower_what_lost_half_of_its_ratio_at_best) {
  const std::vector<SpeedRatio> baseline = {{"disturbed", 10, 9, 11}, {"kept", 2, 2, 2}, {"lost", 10, 9, 11}};
  const std::vector<SpeedRatio> candidate = {
      {"lost", 4.7, 4, 4.9}, {"new", 1, 1, 1}, {"kept", 1.01, 1, 2}, {"disturbed", 4.7, 4, 5.1}};
  const std::vector<SpeedRow> rows = compare_speed(baseline, candidate, "bench.json");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_FALSE(rows[0].slower) << "at best it was not";
  EXPECT_EQ(rows[1].name, "kept");
  EXPECT_DOUBLE_EQ(rows[1].baseline, 2);
  EXPECT_DOUBLE_EQ(rows[1].candidate, 1.01);
  EXPECT_DOUBLE_EQ(rows[1].best, 2);
  EXPECT_DOUBLE_EQ(rows[1].limit, std::sqrt(2));
  EXPECT_FALSE(rows[1].slower);
  EXPECT_EQ(rows[2].name, "lost");
  EXPECT_TRUE(rows[2].slower);
}

TEST(CompareSpeed, sees_that_a_small_ratio_is_gone) {
  // Half of it would be slower than the plain implementation.
  const std::vector<SpeedRow> rows =
      compare_speed({{"small", 1.9, 1.5, 2.3}}, {{"small", 1, 0.8, 1.3}}, "bench.json");
  EXPECT_TRUE(rows[0].slower);
  for (const double baseline : {1.0, 1.9, 4.0, 16.0, 200.0}) {
    EXPECT_GE(speed_limit(baseline), 1);
    EXPECT_LE(speed_limit(baseline), baseline);
  }
  EXPECT_DOUBLE_EQ(speed_limit(16), 8);
}

TEST(CompareSpeed, does_not_pass_over_a_ratio_that_is_gone) {
  const auto compare = [] { compare_speed({{"gone", 2, 2, 2}}, {{"other", 2, 2, 2}}, "bench.json"); };
  EXPECT_THAT(thrown_by<Incomparable>(compare), HasSubstr("bench.json: gone: found nothing"));
}

TEST(SpeedRatios, of_a_damaged_file_are_an_error_or_ratios_that_can_be_kept) {
  const std::vector<std::string> texts = {benchmark_file().dump(), speed_json(parsed(benchmark_file()))};
  std::array<int, 2> refused{}, accepted{};
  for (int trial = 0; trial < 3000; ++trial) {
    RandomStream random(1, "speed_test", trial, "damage");
    const int kind = trial % 2;
    try {
      const std::vector<SpeedRatio> ratios = parse_speed_ratios(damaged_text(texts[kind], random), "damaged");
      EXPECT_EQ(parse_speed_ratios(speed_json(ratios), "kept").size(), ratios.size());
      ++accepted[kind];
    } catch (const Error& error) {
      ++refused[kind];
      EXPECT_THAT(error.what(), HasSubstr("damaged")) << "the message names the file";
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  for (const int kind : {0, 1}) {
    EXPECT_GT(refused[kind], 500) << kind;
    EXPECT_GT(accepted[kind], 0) << kind << ": a changed digit is another valid file";
  }
}

}  // namespace
}  // namespace glovebench::reports
