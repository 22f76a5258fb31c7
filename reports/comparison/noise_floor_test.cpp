#include "reports/comparison/noise_floor.h"

#include <gmock/gmock.h>

#include "core/base/damaged_text.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/comparison/comparison.h"
#include "reports/comparison/example_runs.h"
#include "reports/comparison/gate_rule.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;

constexpr int kSeedsPerResult = 2;
constexpr double kSpread_mm = 0.1;

std::vector<uint64_t> seeds_from(uint64_t first, int count) {
  std::vector<uint64_t> seeds;
  for (int i = 0; i < count; ++i) seeds.push_back(first + i);
  return seeds;
}

/// Every seed has its own level, of known spread; some frames are lost at random.
RunResult simulated(const std::vector<uint64_t>& seeds, double shift_mm = 0, int trajectories = 4) {
  std::vector<ExperimentResult> experiments;
  for (int t = 1; t <= trajectories; ++t) {
    const std::string trajectory = "Tr" + std::to_string(t);
    experiments.push_back(example_experiment(trajectory, seeds, 96, [&](uint64_t seed, int f) {
      const double level = 3 + shift_mm + kSpread_mm * RandomStream(seed, trajectory, 0, "level").normal();
      RandomStream random(seed, trajectory, f, "frame");
      if (random.uniform() < 0.02) return example_lost_frame(f);
      return example_frame(f, level + 0.05 * random.normal(), 5 + 0.1 * random.normal(), 3);
    }));
  }
  return example_named("simulated", std::move(experiments)).result;
}

const NoiseFloor& example_floor() {
  static const NoiseFloor floor = measure_noise_floor(simulated(seeds_from(1000, 24)), kSeedsPerResult);
  return floor;
}

TEST(NoiseFloor, RecoversTheSpreadOverSeeds) {
  const NoiseFloor& floor = example_floor();
  EXPECT_EQ(floor.seeds, 24);
  EXPECT_EQ(floor.seeds_per_result, kSeedsPerResult);
  EXPECT_EQ(floor.entries.size(), 5 * gated_metrics().size());
  // Pooled over 92 degrees of freedom: 7% standard error. An experiment's own may be larger.
  const std::string experiment = "Tr2_DB_open_power_source_subject1_gradient_1";
  EXPECT_GT(floor.find(experiment, "position_error_mm")->spread, 0.85 * kSpread_mm);
  EXPECT_LT(floor.find(experiment, "position_error_mm")->spread, 1.5 * kSpread_mm);
  // The mean of four independent experiments spreads half as much; 23 degrees of freedom, 15%.
  EXPECT_NEAR(floor.find(kAllExperiments, "position_error_mm")->spread, kSpread_mm / 2, 0.45 * kSpread_mm / 2);
  EXPECT_EQ(floor.find(experiment, "mood"), nullptr);
  EXPECT_EQ(floor.find("Tr9", "position_error_mm"), nullptr);
}

TEST(NoiseFloor, NoExperimentHasLessThanTheRootMeanSquareOfAll) {
  RunResult result = simulated(seeds_from(1, 8), 0, 2);
  for (SeedRun& run : result.experiments[0].runs)
    for (FrameRecord& frame : run.frames) frame["rotation_error_deg"] = 3;
  for (SeedRun& run : result.experiments[1].runs)
    for (FrameRecord& frame : run.frames) frame["rotation_error_deg"] = run.seed % 2 == 0 ? 2 : 4;
  const NoiseFloor floor = measure_noise_floor(result, kSeedsPerResult);
  const double own = std::sqrt(8.0 / 7);  // four seeds at -1, four at +1
  EXPECT_NEAR(floor.find(to_string(result.experiments[0].key), "rotation_error_deg")->spread, own / std::sqrt(2.0),
              1e-9);
  EXPECT_NEAR(floor.find(to_string(result.experiments[1].key), "rotation_error_deg")->spread, own, 1e-9);
  EXPECT_NEAR(floor.find(kAllExperiments, "rotation_error_deg")->spread, own / 2, 1e-9);
  // Student's t above 0.01 / (2 * 33 rows) at 14 degrees of freedom, times a difference of two means of two.
  const double effect = floor.find(to_string(result.experiments[1].key), "rotation_error_deg")->minimum_effect;
  EXPECT_NEAR(effect / own, 4.763, 0.005);
}

TEST(NoiseFloor, IsNeverBelowTheToleranceOrTwoFrames) {
  const auto constant = [](uint64_t, int f) { return example_frame(f, 3, 5, 3); };
  const RunResult result =
      example_named("constant", {example_experiment("Tr1", seeds_from(1, 8), 50, constant)}).result;
  for (const NoiseFloorEntry& entry : measure_noise_floor(result, kSeedsPerResult).entries) {
    EXPECT_NEAR(entry.spread, 0, 1e-12);
    EXPECT_DOUBLE_EQ(entry.minimum_effect, entry.quantity.ends_with("percent") ? 2 : 0.01) << entry.quantity;
    EXPECT_NEAR(entry.detectable, entry.minimum_effect, 1e-9);
  }
}

TEST(NoiseFloorLong, OtherSeedsAreNoAlarm) {
  int alarms = 0;
  const CompareConfig config = {.resamples = 500};
  for (int swap = 0; swap < 200; ++swap) {
    const NamedResult first = {"first", simulated(seeds_from(2000 + 4 * swap, 2))};
    const NamedResult second = {"second", simulated(seeds_from(2002 + 4 * swap, 2))};
    alarms += !decide(compare_results(first, second, &example_floor(), {.other_seeds = true}, config), {}).passed();
  }
  EXPECT_LE(alarms, 2) << "1% of the swaps";
}

TEST(NoiseFloorLong, WhatIsCalledDetectableIsDetectedMostly) {
  const double change = example_floor().find(kAllExperiments, "position_error_mm")->detectable;
  EXPECT_GE(change, example_floor().find(kAllExperiments, "position_error_mm")->minimum_effect);
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const NamedResult before = {"before", simulated(seeds_from(5000 + 4 * trial, 2))};
    const NamedResult after = {"after", simulated(seeds_from(5002 + 4 * trial, 2), change)};
    const auto rows =
        compare_results(before, after, &example_floor(), {.other_seeds = true}, {.resamples = 500}).rows;
    found += stops(rows[0]);
  }
  // 90%, measured from 24 seeds of which 100 draws repeat the same few: 12 less or more.
  EXPECT_GE(found, 78);
  EXPECT_LT(found, 100) << "and no more than needed";
}

TEST(NoiseFloor, NeedsEnoughSeedsThatAreTheSameEverywhere) {
  EXPECT_EQ(thrown_by([] { measure_noise_floor(simulated(seeds_from(1, 7)), 2); }),
            "noise floor: Tr1_DB_open_power_source_subject1_gradient_1.seeds: found 7, expected at least 8");
  RunResult result = simulated(seeds_from(1, 8));
  result.experiments[2].runs[3].seed = 99;
  EXPECT_THAT(thrown_by([&] { measure_noise_floor(result, 2); }), HasSubstr("Tr3_"));
  result.experiments.clear();
  EXPECT_THAT(thrown_by([&] { measure_noise_floor(result, 2); }), HasSubstr("experiments: found none"));
}

TEST(NoiseFloor, WhatHasNoValuesHasNoEntry) {
  const auto lost = [](uint64_t, int f) { return example_lost_frame(f); };
  const RunResult result = example_named("lost", {example_experiment("Tr1", seeds_from(1, 8), 64, lost)}).result;
  const NoiseFloor floor = measure_noise_floor(result, kSeedsPerResult);
  EXPECT_EQ(floor.entries.size(), 2u * 4) << "the shares";
  EXPECT_EQ(floor.find(kAllExperiments, "position_error_mm"), nullptr);
  const RunResult brief = example_named("brief", {example_experiment("Tr1", seeds_from(1, 8), 16, lost)}).result;
  EXPECT_EQ(measure_noise_floor(brief, kSeedsPerResult).entries.size(), 2u * 4) << "too short for an interval";
}

NoiseFloor small_floor() {
  return {"quick",
          16,
          2,
          0.01,
          "0123",
          "2026-01-02T03:04:05Z",
          {{"all", "position_error_mm", 0.025, 0.125, 0.25}, {"Tr1", "uncovered_percent", 0, 0.5, 1}}};
}

NoiseFloor read_text(const std::string& text) { return parse_noise_floor(text, "noise_floor.json"); }

TEST(NoiseFloor, RoundTrip) {
  const std::string path = test_folder() + "/noise_floor.json";
  write_file(path, noise_floor_json(small_floor()));
  EXPECT_EQ(read_noise_floor(path), small_floor());
  EXPECT_THROW(read_noise_floor(test_folder() + "/no_such_floor.json"), Error);
}

TEST(NoiseFloor, ErrorsNameTheField) {
  const auto refused = [](const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json json = nlohmann::json::parse(noise_floor_json(small_floor()));
    change(json);
    return thrown_by([&] { read_text(json.dump()); });
  };
  using nlohmann::json;
  EXPECT_THAT(refused([](json& j) { j["format"] = "x"; }), HasSubstr("format: found \"x\""));
  EXPECT_THAT(refused([](json& j) { j["version"] = 2; }), HasSubstr("version: found 2"));
  EXPECT_THAT(refused([](json& j) { j["more"] = 2; }), HasSubstr("unknown key \"more\""));
  EXPECT_THAT(refused([](json& j) { j["seeds"] = 0; }), HasSubstr("seeds: found 0"));
  EXPECT_THAT(refused([](json& j) { j["seeds"] = 7; }), HasSubstr("seeds_per_result: found 2, expected"));
  EXPECT_THAT(refused([](json& j) { j["seeds_per_result"] = 1000000; }),
              HasSubstr("seeds_per_result: found 1000000, expected"));
  EXPECT_THAT(refused([](json& j) { j["family_error"] = 0.2; }), HasSubstr("family_error: found 0.2"));
  EXPECT_THAT(refused([](json& j) { j["family_error"] = 0; }), HasSubstr("family_error: found 0"));
  EXPECT_THAT(refused([](json& j) { j["entries"][0]["minimum_effect"] = 0; }),
              HasSubstr("entries[0].minimum_effect: found 0"));
  EXPECT_THAT(refused([](json& j) { j["entries"][0]["spread"] = -1; }), HasSubstr("entries[0].spread: found -1"));
  EXPECT_THAT(refused([](json& j) { j["entries"][0]["minimum_effect"] = 1e300; }), HasSubstr("minimum_effect"));
  EXPECT_THAT(refused([](json& j) { j["entries"][0]["quantity"] = ""; }), HasSubstr("quantity: found \"\""));
  EXPECT_EQ(refused([](json& j) { j["entries"][0]["quantity"] = "mood_deg"; }), "") << "of another version";
  EXPECT_THAT(refused([](json& j) { j["entries"][1] = j["entries"][0]; }), HasSubstr("entries[1]"));
}

TEST(NoiseFloor, DamageGivesAnErrorOrAReadableFloorButNothingElse) {
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    RandomStream random(3, "noise_floor_test", trial, "damage");
    try {
      const NoiseFloor floor = read_text(damaged_text(noise_floor_json(small_floor()), random));
      EXPECT_NO_THROW(read_text(noise_floor_json(floor)));
      ++accepted;
    } catch (const Error& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr("noise_floor.json"));
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 20) << "another digit is another floor";
}

}  // namespace
}  // namespace glovebench::reports
