#include <gtest/gtest.h>

#include <set>

#include "eval/program.h"
#include "eval/studies/ablations.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Table;

const Cell& cell_of(const Table& table, size_t row, std::string_view key) {
  return table.rows.at(row).at(column_index(table, key));
}
double number_in(const Table& table, size_t row, std::string_view key) {
  return std::get<double>(cell_of(table, row, key));
}

TEST(Ablations, name_settings_that_there_are_and_begin_with_what_they_change) {
  const std::vector<Setting> settings = ablation_settings(profile("paper"));
  std::set<std::string> known, used;
  for (const Setting& setting : settings) {
    EXPECT_TRUE(known.insert(setting.name).second) << setting.name;
    EXPECT_TRUE(setting.tracker.problems().empty()) << setting.name;
  }
  for (const Ablation& ablation : ablations()) {
    EXPECT_GE(ablation.rows.size(), 2U) << ablation.name;
    for (const AblationRow& row : ablation.rows) {
      EXPECT_TRUE(known.contains(row.setting)) << row.setting;
      EXPECT_EQ(row.database, ablation.rows.front().database);
      used.insert(row.setting);
    }
  }
  EXPECT_EQ(used, known);
}

TEST(Ablations, random_postures_are_drawn_once_each_beside_the_three_grasps) {
  const PostureSet chosen = trajectories::posture_set(trajectory_folder(), "DB_20_postures");
  const PostureSet one = random_choice(1), again = random_choice(1), two = random_choice(2);
  EXPECT_EQ(one.name, "DB_20_random_1");
  ASSERT_EQ(one.postures.size(), chosen.postures.size());
  EXPECT_EQ(one.posture_names, chosen.posture_names);
  EXPECT_EQ(one.postures, again.postures);
  for (size_t i = 0; i < one.postures.size(); ++i) {
    EXPECT_EQ(one.postures[i] == chosen.postures[i], i < 3);
    EXPECT_EQ(one.postures[i] == two.postures[i], i < 3);
    for (size_t j = 0; j < i; ++j) EXPECT_NE(one.postures[i], one.postures[j]);
  }
  // Low-dispersion sampling is meant to cover the pool.
  EXPECT_LT(covering_radius_deg(chosen), covering_radius_deg(one));
  EXPECT_LT(covering_radius_deg(chosen), covering_radius_deg(two));
}

const std::string kDatabase = "DB_open_pinch_power";
const std::vector<Ablation> kFew = {
    {"filter", {{"posture", kDefaultSetting, kDatabase}, {"none", "no filter", kDatabase}}},
    {"hand region, clutter in reach",
     {{"box", "clutter", kDatabase}, {"largest component", "clutter, component", kDatabase}}}};

Table measure_few(int threads) {
  Workbench workbench(test_workbench(threads));
  const StudyOptions options = quick_options();
  return ablation_table(run_rows({workbench, options}, kFew), kFew);
}

TEST(AblationsLong, changes_are_against_the_first_row) {
  const Table table = measure_few(2);
  ASSERT_EQ(table.rows.size(), 4U);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(table, 0, "posture_change_deg")));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(table, 2, "posture_change_deg")));
  // The filter changes only the posture, and both ways track all frames of the stretch.
  EXPECT_EQ(number_in(table, 0, "position_error_mm"), number_in(table, 1, "position_error_mm"));
  EXPECT_EQ(number_in(table, 1, "position_change_mm"), 0);
  EXPECT_EQ(number_in(table, 1, "rotation_change_deg"), 0);
  const double change = number_in(table, 1, "posture_change_deg");
  EXPECT_NEAR(change, number_in(table, 1, "posture_error_deg") - number_in(table, 0, "posture_error_deg"), 1e-9);
  EXPECT_NE(change, 0);
  // The stretch is too short for an interval.
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(table, 1, "posture_change_deg_low")));
  // The largest component is the hand, so the clutter has no effect.
  EXPECT_GT(number_in(table, 3, "covered_percent"), 90);
  EXPECT_LT(number_in(table, 2, "covered_percent"), number_in(table, 3, "covered_percent"));
}

TEST(AblationsLong, do_not_depend_on_threads) { EXPECT_EQ(measure_few(1), measure_few(2)); }

TEST(AblationsLong, measures_have_their_names_and_few_frames_no_latency) {
  Workbench workbench(test_workbench());
  const StudyOptions options = quick_options();
  const Runs runs =
      run_rows({workbench, options},
               {kFew.front(),
                {"neighbors", {{"3", kDefaultSetting, "DB_open_power"}, {"1", "1 neighbor", "DB_open_power"}}}});
  const auto lag = lag_measures(runs);
  ASSERT_EQ(lag.size(), 3U);
  EXPECT_EQ(lag[2].name, "lag.filter_share");
  EXPECT_FALSE(lag[2].value.has_value()) << "24 frames are too few for a latency";
  const reports::Measure interpolation = interpolation_measure(runs);
  EXPECT_EQ(interpolation.name, "interpolation.distinct_excess_deg");
  EXPECT_TRUE(interpolation.value.has_value());
}

TEST(LightLong, own_light_is_labeled_best_and_the_mean_is_that_of_the_others) {
  Workbench workbench(test_workbench());
  const StudyOptions options = quick_options();
  const reports::StudyResult result = run_light({workbench, options});
  ASSERT_EQ(result.tables.size(), 2U);
  const Table& light = result.tables[0];
  ASSERT_EQ(light.rows.size(), 6 * (2U + 1 + 1))
      << "two calibrations, three tables; two lightings, its own, the mean";
  double excess = 0, equal_excess = 0;
  for (size_t row = 0; row < light.rows.size(); row += 4) {
    for (const char* key : {"wrong_percent", "missed_percent", "mislabeled_percent"}) {
      const double mean = (number_in(light, row, key) + number_in(light, row + 1, key)) / 2;
      EXPECT_NEAR(number_in(light, row + 3, key), mean, 1e-9);
      if (key != std::string_view("mislabeled_percent")) continue;
      if (row == 12) excess -= mean, equal_excess -= mean;
      if (row == 16) excess += mean;
      if (row == 20) equal_excess += mean;
      EXPECT_GE(mean, number_in(light, row + 3, "missed_percent"));
      EXPECT_LE(mean, 100);
    }
    EXPECT_LT(number_in(light, row + 2, "missed_percent"), number_in(light, row + 3, "missed_percent"));
  }
  ASSERT_EQ(result.measures.size(), 4U);
  EXPECT_EQ(result.measures[1].name, "light.rgb_excess_own_percent");
  EXPECT_EQ(result.measures[0].name, "light.rgb_excess_percent");
  EXPECT_NEAR(*result.measures[0].value, excess, 1e-9);
  EXPECT_EQ(result.measures[2].name, "light.rgb_excess_equal_cells_percent");
  EXPECT_NEAR(*result.measures[2].value, equal_excess, 1e-9);
  EXPECT_NE(equal_excess, excess);
  EXPECT_EQ(result.tables[1].rows.size(), 4U);
}

}  // namespace
}  // namespace glovebench::eval
