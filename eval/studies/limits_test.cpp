#include <gtest/gtest.h>

#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

TEST(LimitsStudyLong, a_truth_makes_errors_smaller) {
  Workbench workbench(test_workbench(2));
  const StudyOptions options = quick_options();
  const std::vector<reports::StudyResult> results = {run_limits({workbench, options})};
  const auto number = [&](std::string_view table, std::string_view key) {
    const reports::Table* found = reports::find_table(results, table);
    return std::get<double>(found->rows.at(0).at(column_index(*found, key)));
  };
  EXPECT_LT(number("limits_fingertips", "own_hand"), number("limits_fingertips", "people"));
  EXPECT_LT(number("limits_fingertips", "frame_before"), number("limits_fingertips", "own_hand"));
  EXPECT_LT(number("limits_posture", "hidden_angles"), number("limits_posture", "own_hand"));
  EXPECT_EQ(number("limits_position", "held"), 0);
  EXPECT_GT(number("limits_position", "hidden_angles"), 0);
}

}  // namespace
}  // namespace glovebench::eval
