// Results that no run writes: whatever the damage, one line says what is wrong.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/example_result.h"
#include "reports/results_json.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string& example_text() {
  static const std::string text = [] {
    RunResult result = small_result();
    result.studies = example_studies();
    return results_json(result);
  }();
  return text;
}

std::string hostile_error(const std::string& text) {
  const std::string error = thrown_by([&] { parse_results(text, "results.json"); });
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

std::string hostile_error_of_change(const std::function<void(json&)>& change) {
  json results = json::parse(example_text());
  change(results);
  return hostile_error(results.dump());
}

/// The first frame of the first seed of the first experiment.
json& first_frame(json& results) { return results["experiments"][0]["runs"][0]["frames"][0]; }

std::string error_of_reading(const std::string& path) {
  return thrown_by([&] { read_results(path); });
}

TEST(HostileResults, NestedAMillionDeep) {
  constexpr size_t kDeep = 1'000'000;
  EXPECT_THAT(hostile_error(std::string(kDeep, '[')), HasSubstr("results.json: nesting: found deeper nesting"));
  std::string objects;
  for (size_t i = 0; i < kDeep; ++i) objects += "{\"a\":";
  EXPECT_THAT(hostile_error(objects), HasSubstr("deeper nesting"));
  std::string text = example_text();
  const std::string key = "\"configuration\": ";
  text.insert(text.find(key) + key.size(),
              "{\"a\": " + std::string(kDeep, '[') + std::string(kDeep, ']') + "}, \"b\": ");
  EXPECT_THAT(hostile_error(text), HasSubstr("deeper nesting"));
}

TEST(HostileResults, BracketsInATextAreNoNesting) {
  json results = json::parse(example_text());
  results["configuration"]["note"] = "\\\"" + std::string(100, '[');
  EXPECT_EQ(hostile_error(results.dump()), "");
}

TEST(HostileResults, NumbersThatNoErrorHas) {
  const auto with_number = [](const std::string& number) {
    json results = json::parse(example_text());
    first_frame(results)[9] = "NUMBER";
    std::string text = results.dump();
    return hostile_error(text.replace(text.find("\"NUMBER\""), 8, number));
  };
  EXPECT_THAT(with_number("1e999"), HasSubstr("expected a finite number"));
  EXPECT_THAT(with_number("NaN"), HasSubstr("expected JSON"));
  EXPECT_THAT(with_number("Infinity"), HasSubstr("expected JSON"));
  for (const char* number : {"1e308", "1000000.5", "-0.5", "-1e308", "18446744073709551615", "\"4\"", "true", "[]"})
    EXPECT_THAT(with_number(number), HasSubstr("runs[0].frames[0][9]: found")) << number;
}

TEST(HostileResults, NumbersBesideTheFramesThatWouldOverflow) {
  EXPECT_THAT(hostile_error_of_change(
                  [](json& r) { r["experiments"][0]["aggregates"]["position_error_mm"]["max"] = 1e308; }),
              HasSubstr("aggregates.position_error_mm.max"));
  EXPECT_THAT(hostile_error_of_change([](json& r) { r["experiments"][0]["noise"]["factor"] = -1; }),
              HasSubstr("noise.factor"));
  EXPECT_THAT(hostile_error_of_change([](json& r) { r["experiments"][0]["joint_pck"]["shares"][3] = 1.5; }),
              HasSubstr("joint_pck.shares[3]"));
  EXPECT_THAT(hostile_error_of_change([](json& r) { r["experiments"][0]["sequence"]["latency_frames"] = 1e300; }),
              HasSubstr("sequence.latency_frames"));
}

TEST(HostileResults, MeansThatTheFramesDoNotHave) {
  const auto mean = [](json& r) -> json& { return r["experiments"][0]["aggregates"]["position_error_mm"]["mean"]; };
  EXPECT_THAT(hostile_error_of_change([&](json& r) { mean(r) = 3.9; }),
              HasSubstr("aggregates.position_error_mm.mean: found 3.9, expected the mean of the frames"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { mean(r) = nullptr; }), HasSubstr("position_error_mm.mean"));
  EXPECT_THAT(hostile_error_of_change([](json& r) { first_frame(r)[9] = 3.5; }),
              HasSubstr("position_error_mm.mean"));
  const size_t residual = 9 + metric_index("icp_residual_mm");  // a tracked frame may lack it
  EXPECT_THAT(hostile_error_of_change([&](json& r) { first_frame(r)[residual] = nullptr; }),
              HasSubstr("icp_residual_mm.count"));
}

TEST(HostileResults, WhatComesTwice) {
  EXPECT_THAT(hostile_error_of_change([](json& r) { r["experiments"].push_back(r["experiments"][0]); }),
              HasSubstr("experiments[4]: found an object, expected each experiment once"));
  EXPECT_THAT(hostile_error_of_change([](json& r) { r["experiments"][0]["runs"][1]["seed"] = 1; }),
              HasSubstr("runs[1].seed: found 1, expected each seed once"));
}

TEST(HostileResults, FramesThatDoNotFollowEachOther) {
  const auto frame = [](json& r, int run, int row) -> json& {
    return r["experiments"][0]["runs"][run]["frames"][row];
  };
  EXPECT_THAT(hostile_error_of_change([&](json& r) { frame(r, 0, 1)[0] = 0; }),
              testing::ContainsRegex("frames\\[1\\]: found an array of [0-9]+, expected a frame after 0"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { frame(r, 0, 1)[1] = 0; }),
              HasSubstr("expected a time stamp after 0"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { frame(r, 1, 1)[1] = 7; }), HasSubstr("runs[1].frames[1]"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) {
                frame(r, 1, 0)[0] = 1;
                frame(r, 1, 1)[0] = 2;
              }),
              HasSubstr("runs[1].frames[0]"));
}

TEST(HostileResults, NamesThatLeadOutOfTheFolder) {
  for (const char* name :
       {"../../Tr4", "/Tr4", "..", "", "Tr4\n", "a\x7f", "=Tr4", "x/../../../escaped/evil", ".hidden"}) {
    EXPECT_THAT(hostile_error_of_change([&](json& r) { r["experiments"][0]["trajectory"] = name; }),
                HasSubstr("trajectory"));
    EXPECT_THAT(hostile_error_of_change([&](json& r) { r["experiments"][0]["database"] = name; }),
                HasSubstr("database"));
  }
}

TEST(HostileResults, StudiesThatNoRunWrites) {
  const auto table = [](json& r) -> json& { return r["studies"][1]["tables"][0]; };
  EXPECT_THAT(hostile_error_of_change([&](json& r) { table(r)["name"] = "../../figure8"; }),
              HasSubstr("studies[1].tables[0].name"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { table(r)["name"] = "figure7"; }),
              HasSubstr("studies[1].tables[0].name: found \"figure7\", expected each table name once"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { table(r)["rows"][3].push_back(nullptr); }),
              HasSubstr("rows[3]: found an array of 14, expected one cell for each of columns"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { table(r)["rows"][0][5] = 1e308; }), HasSubstr("rows[0][5]"));
  EXPECT_THAT(hostile_error_of_change([&](json& r) { table(r)["rows"][0][5] = json::object(); }),
              HasSubstr("rows[0][5]"));
  EXPECT_THAT(hostile_error_of_change([](json& r) { r["studies"] = nullptr; }), HasSubstr("studies: found null"));
}

TEST(HostileResults, FilesThatCannotBeRead) {
  const std::string folder = test_folder();
  fs::create_directories(folder + "/results.json");
  EXPECT_THAT(error_of_reading(folder + "/results.json"), HasSubstr("found a folder"));
  EXPECT_THAT(error_of_reading(folder + "/none.json"), HasSubstr("No such file"));
  EXPECT_THAT(error_of_reading("/proc/self/mem"), HasSubstr("Input/output error"));

  const std::string large = folder + "/large.json";
  write_file(large, example_text());
  fs::resize_file(large, 2'000'000'000);  // a sparse file
  EXPECT_THAT(error_of_reading(large),
              AllOf(HasSubstr("large.json: size: found more than"), HasSubstr("256000000")));

  fs::permissions(folder, fs::perms::others_exec, fs::perm_options::add);  // else the folder would be refused
  const std::string secret = folder + "/secret.json";
  write_file(secret, example_text());
  fs::permissions(secret, fs::perms::none);
  // Permissions do not bind the superuser, as which some machines run tests.
  const uid_t self = geteuid();
  ASSERT_TRUE(self != 0 || seteuid(65534) == 0);
  EXPECT_THAT(error_of_reading(secret), HasSubstr("Permission denied"));
  ASSERT_EQ(seteuid(self), 0);
  fs::remove_all(folder);
}

TEST(HostileResults, TruncatedAnywhere) {
  const std::string& small = example_text();
  for (size_t length = 0; length < small.size(); length += 100)
    EXPECT_THAT(hostile_error(small.substr(0, length)), HasSubstr("expected JSON")) << length;
  const std::string full = results_json(full_result());
  for (size_t length = 1000; length < full.size(); length += 99'000)
    EXPECT_THAT(hostile_error(full.substr(0, length)), HasSubstr("expected JSON")) << length;
}

/// Picks a value at any depth.
json& random_value(json& document, RandomStream& random) {
  json* value = &document;
  while (value->is_structured() && !value->empty() && random.index(8) != 0)
    value = &*std::next(value->begin(), static_cast<std::ptrdiff_t>(random.index(value->size())));
  return *value;
}

/// Replaces, removes, doubles or exchanges values; keeps the syntax valid.
std::string damaged(RandomStream& random) {
  static const std::vector<json> strangers = {nullptr,
                                              true,
                                              -1,
                                              0,
                                              1e308,
                                              -1e308,
                                              0.5,
                                              1e6,
                                              uint64_t{18446744073709551615u},
                                              "",
                                              "tracked",
                                              "../x",
                                              json::array(),
                                              json::object(),
                                              json::array({1, 2}),
                                              "\xc3\xa9"};
  static const json undamaged = json::parse(example_text());
  json document = undamaged;
  json& value = random_value(document, random);
  switch (random.index(4)) {
    case 0:
      value = strangers[random.index(strangers.size())];
      break;
    case 1:
      if (value.is_array() && !value.empty()) value.push_back(value[random.index(value.size())]);
      if (value.is_number_float()) value = value.get<double>() + 0.25;
      if (value.is_number_integer()) value = value.get<int64_t>() + 1;
      break;
    case 2:
      if (value.is_structured() && !value.empty())
        value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(random.index(value.size()))));
      break;
    default: {
      const json other = random_value(document, random);
      random_value(document, random) = other;
    }
  }
  return document.dump();
}

TEST(HostileResults, ExchangedValuesGiveAnErrorOrAResultThatCanBeWrittenAgain) {
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    RandomStream random(1, "hostile_results_test", trial, "damage");
    const std::string text = damaged(random);
    try {
      const RunResult read = parse_results(text, "results.json");
      ++accepted;
      EXPECT_FALSE(results_json(read).empty());
      // Reports compute with the frames, so results must be finite.
      for (const ExperimentResult& e : read.experiments)
        summarize(e.key, e.runs, e.pck, e.sequence, {.resamples = 10});
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(accepted, 30) << "another commit, say, is another result: the damage reaches the values";
}

}  // namespace
}  // namespace glovebench::reports
