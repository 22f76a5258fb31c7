#include "reports/page/gallery.h"

#include <gmock/gmock.h>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

using testing::ElementsAre;

ExperimentResult experiment(const std::string& trajectory, TruthKind truth, std::vector<FrameRecord> frames) {
  return summarize({trajectory, "DB", truth, 1, {}}, {{7, std::move(frames)}}, pck_curve({}, 0), {},
                   {.resamples = 10});
}

std::vector<std::string> names(const std::vector<WorstFrame>& frames) {
  std::vector<std::string> names;
  for (const WorstFrame& worst : frames)
    names.push_back(worst.key.trajectory + ":" + std::to_string(worst.frame.frame));
  return names;
}

TEST(Gallery, TakesTheLargestOfEachErrorAtMostTwoOfAnExperiment) {
  RunResult result;
  // Frames are 1/15 s apart: 0, 10 and 20 may be chosen together, 11 is too close to 10.
  result.experiments = {
      experiment("A", TruthKind::source,
                 {example_frame(0, 30, 1, 1), example_lost_frame(5), example_frame(10, 40, 1, 1),
                  example_frame(11, 39, 1, 1), example_frame(20, 29, 50, 1)}),
      experiment("B", TruthKind::source, {example_frame(0, 5, 20, 1), example_frame(9, 6, 10, 1)}),
      experiment("C", TruthKind::recorded, {example_frame(0, 99, 99, 1)})};
  const std::vector<WorstFrame> worst = worst_frames(result, 4);
  EXPECT_THAT(names(worst), ElementsAre("A:10", "A:0", "B:0", "B:9"))
      << "A:20 has the largest posture error, but A has two frames already; C is not on source";
  EXPECT_EQ(worst[0].metric, "position_error_mm");
  EXPECT_EQ(worst[2].metric, "posture_rms_deg");
  EXPECT_EQ(worst[0].seed, 7U);
}

TEST(Gallery, TakesOtherExperimentsWhereNoneIsOnSource) {
  RunResult result;
  EXPECT_TRUE(worst_frames(result).empty());
  result.experiments = {experiment("C", TruthKind::recorded, {example_frame(3, 9, 9, 1)})};
  EXPECT_THAT(names(worst_frames(result)), ElementsAre("C:3"));
}

TEST(Gallery, CommandNamesExperimentAndSeedForTheShell) {
  WorstFrame worst{{"Tr4", "DB_open_power", TruthKind::source, 1, {}}, 3, example_frame(12, 4, 5, 6), ""};
  EXPECT_EQ(explain_command(worst),
            "glovebench explain . 12 --experiment Tr4_DB_open_power_source_subject1_gradient_1 --seed 3");
  worst.key.trajectory = "it's";
  EXPECT_THAT(explain_command(worst), testing::HasSubstr("--experiment 'it'\\''s_DB_open_power"));
  EXPECT_EQ(caption(worst),
            "it's with DB_open_power, source truth, frame 12, noise seed 3: 4.0 mm, posture 5.0 deg, "
            "rotation 6.0 deg");
}

}  // namespace
}  // namespace glovebench::reports
