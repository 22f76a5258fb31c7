#include <gtest/gtest.h>

#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using reports::StudyResult;
using reports::Table;

StudyResult tested_monocular(int threads) {
  Workbench workbench(test_workbench(threads));
  const StudyOptions options = quick_options();
  return measure_monocular({workbench, options}, {"DB_open_pinch_power"});
}

TEST(MonocularStudyLong, depth_tells_the_distance_that_the_color_image_does_not) {
  const StudyResult result = tested_monocular(2);
  ASSERT_EQ(result.tables.size(), 1U);
  const Table& table = result.tables[0];
  ASSERT_EQ(table.rows.size(), 4U) << "two methods, two subjects";
  const auto number = [&](size_t row, std::string_view key) {
    return std::get<double>(table.rows[row].at(column_index(table, key)));
  };
  for (size_t row = 0; row < 4; ++row) {
    // The position error is the length of the offset; the columns hold its two parts.
    const double depth_mm = 10 * number(row, "depth_error_cm"), lateral_mm = number(row, "lateral_error_mm");
    EXPECT_GE(number(row, "position_error_mm"), std::hypot(depth_mm, lateral_mm) - 1e-6);
    EXPECT_LE(number(row, "position_error_mm"), depth_mm + lateral_mm + 1e-6);
  }
  for (const size_t subject : {0, 2}) {
    EXPECT_EQ(std::get<std::string>(table.rows[subject][0]), "monocular_bbox");
    EXPECT_EQ(std::get<std::string>(table.rows[subject + 1][0]), "schroeder2012");
    EXPECT_GT(number(subject, "depth_error_cm"), 2 * number(subject + 1, "depth_error_cm"));
  }
  ASSERT_EQ(result.measures.size(), 1U);
  EXPECT_EQ(*result.measures[0].value, number(0, "depth_error_cm"));
}

TEST(MonocularStudyLong, does_not_depend_on_threads) { EXPECT_EQ(tested_monocular(1), tested_monocular(2)); }

}  // namespace
}  // namespace glovebench::eval
