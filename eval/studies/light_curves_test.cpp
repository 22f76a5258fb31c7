#include "eval/studies/light_curves.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "eval/test_program.h"
#include "render/lighting.h"

namespace glovebench::eval {
namespace {

TEST(WhiteBalance, is_a_gain_on_light) {
  ColorImage color(2, 1);
  color[0] = {188, 188, 188};  // half of the light
  color[1] = {10, 200, 255};
  EXPECT_EQ(render::with_white_balance(color, {1, 1, 1}), color);
  const ColorImage drifted = render::with_white_balance(color, {0.5, 2, 1});
  EXPECT_EQ(drifted[0], (Rgb{137, 255, 188}));
  EXPECT_EQ(drifted[1], (Rgb{5, 255, 255})) << "the curve is straight at its foot, and cut off at white";
}

TEST(LightCurves, vary_one_thing_each_and_pass_the_default) {
  for (const LightAxis& axis : light_axes(false)) {
    int defaults = 0;
    for (const LightPoint& point : axis.points) {
      EXPECT_TRUE(point.lighting.problems().empty());
      defaults += point.lighting == render::Lighting{} && point.white_balance == Eigen::Vector3d::Ones();
    }
    EXPECT_EQ(defaults, 1) << axis.table;
  }
}

double right_percent(const LightWay& way) { return way.errors ? 100 - 100 * way.errors->mislabeled_share() : 0; }

/// [own table, majority, surface majority, recalibrated, with surface majority, best table], all printed.
std::vector<double> print_point(Workbench& workbench, int subject, const LightPoint& point) {
  std::vector<double> right;
  std::printf("subject %d, strength %.2f, %.0f K, green %.2f\n", subject, point.lighting.strength,
              point.lighting.temperature_k, point.white_balance[1]);
  for (const LightWay& way : measure_light_point(workbench, subject, point)) {
    right.push_back(right_percent(way));
    if (way.errors)
      std::printf("  %-32s right %6.2f%%  inside %6.2f%%  at borders %6.2f%%\n", way.name.c_str(), right.back(),
                  100 - 100 * way.errors->interior_mislabeled_share(),
                  100 - 100 * way.errors->border_mislabeled_share());
  }
  return right;
}

TEST(LightCurvesLong, a_table_of_a_recording_is_no_worse_than_the_trackers_own) {
  Workbench workbench(test_workbench());
  // Usual light, warm and weak light, a drift of the white balance, a glove with other dyes.
  const std::vector<std::pair<int, LightPoint>> points = {{2, {1, {}}},
                                                          {1, {0.35, {.strength = 0.35, .temperature_k = 3200}}},
                                                          {2, {1.25, {}, Eigen::Vector3d(1, 1.25, 1)}}};
  for (const auto& [subject, point] : points) {
    const std::vector<double> right = print_point(workbench, subject, point);
    // Measured: 96.0 to 96.7% and, with the filter, 98.2 to 98.4%; the own table 88.5 to 95.5% and 95.5 to 98.1%.
    EXPECT_GT(right[3], right[0] + 0.3);
    EXPECT_GE(right[4], right[2] - 0.05) << "the filter mends most of what either misses";
    EXPECT_GT(right[3], 95.5);
    EXPECT_GT(right[4], 98.0) << "the target";
  }
}

TEST(LightCurvesLong, a_table_of_a_recording_goes_on_where_the_trackers_own_breaks) {
  Workbench workbench(test_workbench());
  const std::vector<std::pair<int, LightPoint>> points = {{1, {0.18, {.strength = 0.18}}},
                                                          {2, {2500, {.temperature_k = 2500}}},
                                                          {1, {1.667, {}, Eigen::Vector3d(1, 1.667, 1)}}};
  for (const auto& [subject, point] : points) {
    const std::vector<double> right = print_point(workbench, subject, point);
    EXPECT_LT(right[0], 92) << "or the point says nothing";
    EXPECT_GT(right[3], 95.5);
    EXPECT_GT(right[4], 98.0);
  }
}

TEST(LightCurvesLong, make_a_table_for_each_axis) {
  Workbench workbench(test_workbench());
  const StudyOptions options = quick_options();
  const reports::StudyResult result = run_light_curves({workbench, options});
  ASSERT_EQ(result.tables.size(), 3U);
  for (const reports::Table& table : result.tables) {
    EXPECT_EQ(table.rows.size(), 6U * 2U);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  ASSERT_EQ(result.measures.size(), 6U);
  EXPECT_GT(result.measures[3].value.value_or(0), result.measures[0].value.value_or(100))
      << "recalibrated against the own table";
}

}  // namespace
}  // namespace glovebench::eval
