#include "bench/speed_table.h"

#include <gmock/gmock.h>

namespace glovebench::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Measured measured(const std::vector<double>& seconds) {
  Measured result;
  for (size_t i = 0; i < seconds.size(); ++i) result.seconds[static_cast<int64_t>(i)] = seconds[i];
  return result;
}

Measured missing() {
  Measured result;
  result.missing = true;
  return result;
}

std::vector<std::string> names(const std::vector<EngineRatio>& ratios) {
  std::vector<std::string> result;
  for (const EngineRatio& ratio : ratios) result.push_back(ratio.stage + "/" + ratio.engine);
  return result;
}

TEST(SpeedTable, compares_medians_and_spreads_over_the_same_repetitions) {
  const std::vector<EngineRatio> ratios =
      engine_ratios({{"a/b/plain", measured({8, 12, 10})}, {"a/b/fast", measured({4, 2, 2})}});
  ASSERT_EQ(ratios.size(), 1);
  EXPECT_EQ(ratios[0].stage, "a/b");
  EXPECT_EQ(ratios[0].engine, "plain");
  EXPECT_EQ(ratios[0].seconds, 10);
  EXPECT_EQ(ratios[0].fast_seconds, 2);
  EXPECT_EQ(ratios[0].ratio, 5);
  EXPECT_EQ(ratios[0].low, 2);
  EXPECT_EQ(ratios[0].high, 6);
}

TEST(SpeedTable, takes_the_mean_of_the_middle_two) {
  const std::vector<EngineRatio> ratios =
      engine_ratios({{"a/peer", measured({1, 2, 4, 100})}, {"a/fast", measured({1, 1, 1, 1})}});
  ASSERT_EQ(ratios.size(), 1);
  EXPECT_EQ(ratios[0].ratio, 3);
}

TEST(SpeedTable, lists_the_plain_one_first_and_only_what_has_a_fast_one) {
  const Measurements measurements = {
      {"a/another", measured({2})}, {"a/fast", measured({1})}, {"a/plain", measured({3})}, {"alone", measured({1})},
      {"b/plain", measured({1})},   {"c/fast", measured({1})}, {"c/failed", Measured{}}};
  EXPECT_THAT(names(engine_ratios(measurements)), ElementsAre("a/plain", "a/another"));
}

TEST(SpeedTable, shows_a_missing_library_as_missing) {
  const Measurements measurements = {{"a/fast", measured({0.001})}, {"a/peer", missing()}};
  const std::vector<EngineRatio> ratios = engine_ratios(measurements);
  ASSERT_EQ(ratios.size(), 1);
  EXPECT_TRUE(ratios[0].missing);
  EXPECT_THAT(ratio_lines(ratios), HasSubstr("missing"));
  EXPECT_THAT(speed_markdown(measurements), HasSubstr("| a | peer | missing | | | |\n"));
}

TEST(SpeedTable, the_floor_is_what_is_touched_over_what_memory_delivers) {
  Measured near = measured({1}), far = measured({1}), stage = measured({7, 6, 5});
  near.near_bytes = 100;
  far.far_bytes = 10;
  stage.near_bytes = 200;
  stage.far_bytes = 10;
  const std::vector<StageFloor> floors =
      stage_floors({{kNearBandwidth, near}, {kFarBandwidth, far}, {"stage", stage}, {"silent", measured({1})}});
  ASSERT_EQ(floors.size(), 1);
  EXPECT_EQ(floors[0].benchmark, "stage");
  EXPECT_EQ(floors[0].bytes, 210);
  EXPECT_EQ(floors[0].floor_seconds, 3);
  EXPECT_EQ(floors[0].seconds, 6);
}

TEST(SpeedTable, has_no_floors_without_the_bandwidth) {
  Measured stage = measured({1});
  stage.far_bytes = 10;
  EXPECT_THAT(stage_floors({{"stage", stage}}), IsEmpty());
  EXPECT_THAT(speed_markdown({{"stage", stage}}), Not(HasSubstr("floor")));
}

TEST(SpeedTable, writes_three_digits_and_no_exponent) {
  const std::string text =
      speed_markdown({{"a/plain", measured({12.3456, 12.3456})}, {"a/fast", measured({0.0123456, 0.0123456})}});
  EXPECT_THAT(text, HasSubstr("| a | plain | 12346 | 12.3 | 1000 | 1000 to 1000 |"));
}

}  // namespace
}  // namespace glovebench::bench
