#include "eval/studies/filter_reading.h"

#include <gmock/gmock.h>

#include "reports/paper_numbers.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentResult;
using reports::RunResult;

TEST(FilterReading, RatiosAreOfFallingErrorsThatAreNotTooSmall) {
  const ErrorSeries errors = {4.0, 3.0, 3.0, 6.0, std::nullopt, 2.0, 1.0, 0.001, 0.0};
  EXPECT_THAT(falling_ratios(errors), testing::ElementsAre(0.75, 0.5));  // 4 to 3, 2 to 1; then too small
  EXPECT_THAT(falling_ratios({}), testing::IsEmpty());
  EXPECT_THAT(falling_ratios({1.0}), testing::IsEmpty());
}

TEST(FilterReading, AutocorrelationByHand) {
  // Differences from the mean 2: -1, 0, 1, 0. Products 0, 0, 0. A saw has -1, 1, -1, 1: -3 / 4.
  EXPECT_DOUBLE_EQ(*autocorrelation({1.0, 2.0, 3.0, 2.0}), 0);
  EXPECT_DOUBLE_EQ(*autocorrelation({1.0, 3.0, 1.0, 3.0}), -0.75);
  // -1.5, -0.5, 0.5, 1.5: (0.75 - 0.25 + 0.75) / 5.
  EXPECT_DOUBLE_EQ(*autocorrelation({1.0, 2.0, 3.0, 4.0}), 0.25);
  // The lost frame has no neighbors: -1, lost, 1, 0, so 0 / 2.
  EXPECT_DOUBLE_EQ(*autocorrelation({1.0, std::nullopt, 3.0, 2.0}), 0);
  EXPECT_FALSE(autocorrelation({}).has_value());
  EXPECT_FALSE(autocorrelation({std::nullopt}).has_value());
  EXPECT_FALSE(autocorrelation({2.0, 2.0}).has_value()) << "no value differs";
}

std::vector<double> column_of(const reports::Table& table, std::string_view key) {
  std::vector<double> values;
  for (const reports::Row& row : table.rows)
    if (const auto* value = std::get_if<double>(&row[column_index(table, key)])) values.push_back(*value);
  return values;
}

TEST(FilterReading, WhatThePrintedCurvesSay) {
  const reports::Table table = filter_table("filter", {}, {});
  const std::vector<double> printed = column_of(table, "printed");
  ASSERT_EQ(printed.size(), table.rows.size());
  EXPECT_NEAR(printed[0], 0.75, 5e-5) << "the share of the posture that a frame keeps";
  EXPECT_GT(printed[1], 70) << "most steps; the others are of a hand that moves";
  EXPECT_NEAR(printed[2], 0.22, 0.005) << "the rotation errors of Figure 5";
  EXPECT_NEAR(printed[4], reports::paper_numbers().figure_5.mean.position_mm, 1e-3) << "as the figure prints it";
  EXPECT_NEAR(printed[7], reports::paper_numbers().figure_6.mean.position_mm, 1e-3);
  EXPECT_THAT(column_of(table, "paper"), testing::IsEmpty()) << "nothing was run";
}

TEST(FilterReading, OurRunsAreTheExperimentsOfTheCurves) {
  RunResult result;
  ExperimentResult& experiment = result.experiments.emplace_back();
  experiment.key = {"Tr4", "DB_open_power", reports::TruthKind::recorded, 1, {}};
  for (const double error : {4.0, 2.0, 1.0}) {
    reports::FrameRecord& frame = experiment.runs.emplace_back().frames.emplace_back();
    frame["posture_rms_deg"] = error;
    frame["rotation_error_deg"] = error;
  }
  // Seeds are no neighbors in time: three runs of one frame.
  EXPECT_THAT(column_of(filter_table("filter", result, {}), "paper"), testing::IsEmpty());
  experiment.runs.resize(1);
  for (const double error : {2.0, 1.0}) {
    reports::FrameRecord& frame = experiment.runs[0].frames.emplace_back();
    frame["posture_rms_deg"] = error;
    frame["rotation_error_deg"] = error;
  }
  // 5/3, -1/3, -4/3: (-5/9 + 4/9) / (42/9).
  EXPECT_THAT(column_of(filter_table("filter", {}, result), "literal"),
              testing::ElementsAre(0.5, 0, testing::DoubleNear(-1.0 / 42, 1e-12)));
}

}  // namespace
}  // namespace glovebench::eval
