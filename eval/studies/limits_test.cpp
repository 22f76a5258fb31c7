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
  // Angles that were last seen elsewhere can be worse than estimated ones, but they are worse than true ones.
  EXPECT_GT(number("limits_posture", "oracle"), number("limits_posture", "hidden_angles"));
  EXPECT_LE(number("limits_usable", "oracle"), number("limits_usable", "hidden_angles"));
}

}  // namespace
}  // namespace glovebench::eval
