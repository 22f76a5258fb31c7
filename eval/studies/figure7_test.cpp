#include "eval/studies/figure7.h"

#include <gtest/gtest.h>

#include "core/database/test_database.h"
#include "eval/studies/trial_queries.h"
#include "eval/test_program.h"
#include "eval/true_neighbor.h"

namespace glovebench::eval {
namespace {

using reports::StudyResult;
using reports::Table;

TEST(RankOf, counts_the_smaller_errors_and_half_of_the_equal_ones) {
  const std::vector<float> errors = {3, 1, 2, 2, 5, 2};
  EXPECT_EQ(rank_of(errors, 1), 1);
  EXPECT_EQ(rank_of(errors, 2), 3) << "ranks 2, 3 and 4 are shared";
  EXPECT_EQ(rank_of(errors, 5), 3);
  EXPECT_EQ(rank_of(errors, 0), 5);
  EXPECT_EQ(rank_of(errors, 4), 6);
}

TEST(Figure7, is_set_up_with_about_8000_images_and_500_queries) {
  const Figure7Setup setup = figure7_setup(false);
  EXPECT_EQ(setup.postures.postures.size() * kViewCount, 8316U);
  EXPECT_EQ(setup.postures.posture_names.size(), setup.postures.postures.size());
  EXPECT_EQ(setup.queries, 500);
  const std::vector<int> sizes = {8, 12, 16, 24, 32, 48, 64};
  EXPECT_EQ(setup.sizes, sizes);
  for (const bool quick : {false, true}) {
    const std::vector<std::string>& names = figure7_setup(quick).postures.posture_names;
    const std::vector<std::string> first(names.begin(), names.begin() + 3);
    EXPECT_EQ(first, (std::vector<std::string>{"open", "pinch", "power"})) << "those of DB_open_pinch_power";
  }
}

StudyResult tested_figure7(int threads) {
  Workbench workbench(test_workbench(threads));
  StudyOptions options;
  options.tracker = profile("paper");
  return measure_figure7({workbench, options}, {test_postures(), {8, 64}, 10});
}

/// Without what is a time.
StudyResult without_times(StudyResult result) {
  std::erase_if(result.measures, [](const reports::Measure& measure) { return measure.is_time; });
  for (Table& table : result.tables) {
    for (size_t c = table.columns.size(); c-- > 0;) {
      if (!table.columns[c].is_time) continue;
      for (auto& row : table.rows) row[c] = {};
    }
  }
  return result;
}

double number(const Table& table, size_t row, std::string_view key) {
  return std::get<double>(table.rows.at(row).at(column_index(table, key)));
}

TEST(Figure7Long, ranks_lie_in_range_and_do_not_depend_on_threads) {
  const StudyResult result = tested_figure7(1);
  EXPECT_EQ(result.name, "fig7");
  ASSERT_EQ(result.tables.size(), 1U);
  const Table& table = result.tables.front();
  ASSERT_EQ(table.rows.size(), 2U);
  constexpr double kEntries = 1512;
  for (size_t row = 0; row < 2; ++row) {
    ASSERT_EQ(table.rows[row].size(), table.columns.size());
    EXPECT_GE(number(table, row, "mean_rank_low"), 1);
    EXPECT_LE(number(table, row, "mean_rank_low"), number(table, row, "mean_rank"));
    EXPECT_LE(number(table, row, "mean_rank"), number(table, row, "mean_rank_high"));
    EXPECT_LE(number(table, row, "mean_rank_high"), kEntries);
    EXPECT_LE(number(table, row, "first_percent"), number(table, row, "in_first_500_percent"));
    EXPECT_LE(number(table, row, "in_first_500_percent"), 100);
    EXPECT_GT(number(table, row, "distance_us"), 0);
  }
  // By chance the true neighbor would have the middle rank.
  EXPECT_LT(number(table, 1, "mean_rank"), 0.1 * kEntries);

  const std::vector<StudyResult> all = {result};
  const reports::Measure* const steps = find_measure(all, "figure7.steps_with_lower_rank");
  ASSERT_NE(steps, nullptr);
  EXPECT_EQ(steps->value, number(table, 1, "mean_rank") < number(table, 0, "mean_rank") ? 1 : 0);
  const reports::Measure* const ratio = find_measure(all, "figure7.mean_rank_8px_over_64px");
  ASSERT_NE(ratio, nullptr);
  EXPECT_DOUBLE_EQ(ratio->value.value(), number(table, 0, "mean_rank") / number(table, 1, "mean_rank"));
  ASSERT_TRUE(ratio->interval.has_value());
  EXPECT_LE(ratio->interval->low, *ratio->value);
  EXPECT_GE(ratio->interval->high, *ratio->value);

  EXPECT_TRUE(without_times(result) == without_times(tested_figure7(2)));
}

TEST(Figure7Long, a_clean_query_at_a_view_of_the_database_has_rank_1) {
  const Database& database = test_database();
  Workbench workbench(test_workbench());
  render::NoiseConfig clean;
  clean.depth = "none";
  clean.color_sigma_gray = 0;
  TrialCamera camera(workbench, profile("paper"), clean);
  const TrueNeighborSearch search(*workbench.model(), database);
  int seen = 0;
  for (const int position : {1, 7, 11, 23, 30, 41}) {
    for (const int posture : {0, 1}) {
      const int entry = posture * kViewCount + position * kInPlaneRotations + 5;
      HandFrame hand{0, database.posture(entry), Eigen::Isometry3d::Identity()};
      hand.T_camera_hand.linear() = view_rotations()[Database::view(entry)];
      hand.T_camera_hand.translation().z() = ViewConfig{}.distance;
      const std::optional<LabelImage> labels = camera.see(hand, {1, "figure 7 test", entry});
      if (!labels) continue;
      ++seen;
      const LabelImage query = make_tiny_image(*labels, bounding_square(*labels), 64);
      const TrueNeighbor neighbor = search.nearest(hand.posture, hand.T_camera_hand, workbench.calibration().ir);
      EXPECT_EQ(neighbor.entry, entry);
      EXPECT_EQ(rank_of(distances(database, query), neighbor.entry), 1) << "entry " << entry;
    }
  }
  EXPECT_GE(seen, 10);
}

}  // namespace
}  // namespace glovebench::eval
