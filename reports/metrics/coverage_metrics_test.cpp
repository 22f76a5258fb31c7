#include "reports/metrics/coverage.h"

#include <gtest/gtest.h>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

FrameRecord coverage_frame(double position_mm, double rotation_deg, double fingertips_mm, double visible_percent) {
  FrameRecord frame = example_frame(0, position_mm, 3, rotation_deg);
  frame["fingertip_error_mm"] = fingertips_mm;
  frame["visible_percent"] = visible_percent;
  return frame;
}

TEST(CoverageLevels, UsableEndsAt10MillimetersAnd10DegreesAndFingertipsAt20Millimeters) {
  EXPECT_EQ(is_usable(coverage_frame(9.99, 9.99, 19.99, 100)), true);
  EXPECT_EQ(is_usable(coverage_frame(10, 0, 0, 100)), false);
  EXPECT_EQ(is_usable(coverage_frame(0, 10, 0, 100)), false);
  EXPECT_EQ(is_usable(coverage_frame(0, 0, 20, 100)), false);
  EXPECT_EQ(is_usable(example_lost_frame(0)), false);
}

TEST(CoverageLevels, VisibleBeginsAt30Percent) {
  EXPECT_TRUE(is_visible(coverage_frame(0, 0, 0, 30)));
  EXPECT_FALSE(is_visible(coverage_frame(0, 0, 0, 29.9)));
  EXPECT_FALSE(is_visible(FrameRecord())) << "an older result does not say";
}

TEST(CoverageLevels, FilesThatRoundCountTheSame) {
  FrameRecord nearly = coverage_frame(9.9999999, 0, 0, 29.9999999), written = coverage_frame(10, 0, 0, 30);
  EXPECT_EQ(is_usable(nearly), is_usable(written));
  EXPECT_EQ(is_visible(nearly), is_visible(written));
}

TEST(CoverageLevels, AreSharesOfTheVisibleFrames) {
  const std::vector<SeedRun> runs = {{1,
                                      {coverage_frame(3, 3, 3, 100),    // usable
                                       coverage_frame(20, 3, 15, 80),   // found
                                       coverage_frame(3, 3, 25, 80),    // found: its fingertips are off
                                       coverage_frame(60, 3, 65, 30),   // far off
                                       example_lost_frame(4),           // visible, lost
                                       coverage_frame(3, 3, 3, 10)}}};  // usable, but hardly to be seen
  const Coverage coverage = count_coverage(runs);
  EXPECT_EQ(coverage, (Coverage{6, 4, 1, 1, 1, 5, 3, 1}));
  EXPECT_DOUBLE_EQ(*coverage.found_share(), 3 / 5.0);
  EXPECT_DOUBLE_EQ(*coverage.usable_share(), 1 / 5.0);
  EXPECT_DOUBLE_EQ(*coverage.share(), 4 / 6.0) << "of all frames, as ever";
  double unusable = 0;
  int frames = 0;
  for (const FrameRecord& frame : runs[0].frames) {
    if (const auto value = value_of(metric_of("unusable_percent"), frame)) unusable += *value, ++frames;
  }
  EXPECT_EQ(frames, 5);
  EXPECT_DOUBLE_EQ(unusable, 400);
}

TEST(CoverageLevels, NoVisibleFrameIsNotAShareOf0) {
  const Coverage coverage = count_coverage({{1, {coverage_frame(3, 3, 3, 0)}}});
  EXPECT_FALSE(coverage.found_share() || coverage.usable_share());
}

}  // namespace
}  // namespace glovebench::reports
