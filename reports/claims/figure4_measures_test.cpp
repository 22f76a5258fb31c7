#include "reports/claims/figure4_measures.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

constexpr int kFrames = 60;

/// All frames have the same errors, so all resamples have the same means.
ExperimentResult even_experiment(const ExperimentKey& key, double position_mm, double posture_deg,
                                 double rotation_deg) {
  std::vector<FrameRecord> frames;
  for (int i = 0; i < kFrames; ++i) frames.push_back(example_frame(i, position_mm, posture_deg, rotation_deg));
  return summarize(key, {{1, frames}}, pck_curve({}, 0), {}, {.resamples = 10});
}

/// Errors of a trajectory (1 to 5) with its databases: grasp-specific, three postures, 20 postures.
using Errors = std::function<std::array<double, 3>(int trajectory)>;

/// Figure 4 against one truth; all three errors are equal.
RunResult even_result(TruthKind truth, const Errors& errors) {
  RunResult result;
  for (int t = 1; t <= 5; ++t) {
    const std::string specific = t <= 2 ? "DB_open_pinch" : "DB_open_power";
    const std::array<std::string, 3> databases = {specific, "DB_open_pinch_power", "DB_20_postures"};
    for (size_t d = 0; d < databases.size(); ++d) {
      const double error = errors(t)[d];
      const ExperimentKey key = {"Tr" + std::to_string(t), databases[d], truth, 1, {}};
      result.experiments.push_back(even_experiment(key, error, error, error));
    }
  }
  return result;
}

RunResult ordered_result() {
  return even_result(TruthKind::source, [](int t) { return std::array<double, 3>{1.0 * t, 2.0 * t, 3.0 * t}; });
}

const Measure* find(const std::vector<Measure>& measures, std::string_view name) {
  const auto it = std::ranges::find(measures, name, &Measure::name);
  return it == measures.end() ? nullptr : &*it;
}
double value_of(const RunResult& result, std::string_view name) {
  const std::vector<Measure> measures = figure4_measures(result);
  const Measure* measure = find(measures, name);
  return measure && measure->value ? *measure->value : -1;
}

TEST(Figure4Measures, OrderedDatabases) {
  const std::vector<Measure> measures = figure4_measures(ordered_result());
  for (const char* name :
       {"figure4.ordered_pairs_source", "figure4.specific_best_source", "figure4.large_worst_source"}) {
    const Measure* measure = find(measures, name);
    ASSERT_NE(measure, nullptr) << name;
    EXPECT_EQ(measure->value, 15) << name;
    ASSERT_TRUE(measure->interval) << name;
    EXPECT_EQ(measure->interval->low, 15) << name;
    EXPECT_EQ(measure->interval->high, 15) << name;
    EXPECT_EQ(measure->interval->blocks, 20) << "four blocks of 15 frames in each of five trajectories";
    EXPECT_FALSE(measure->is_time);
  }
  const Measure* largest = find(measures, "figure4.largest_mean_position_error_mm_source");
  ASSERT_NE(largest, nullptr);
  EXPECT_EQ(largest->value, 15) << "Tr5 with the largest database: 3 x 5 mm";
  EXPECT_EQ(largest->unit, "mm");
  ASSERT_TRUE(largest->interval);
  EXPECT_DOUBLE_EQ(largest->interval->high, 15);
}

TEST(Figure4Measures, CountsEachConditionApart) {
  // Tr1: specific best, but the three postures worst. Tr2: large worst, but the three postures best. Tr3: a tie of
  // the best. Tr4 and Tr5: ordered.
  const RunResult result = even_result(TruthKind::source, [](int t) -> std::array<double, 3> {
    if (t == 1) return {1, 3, 2};
    if (t == 2) return {2, 1, 3};
    if (t == 3) return {1, 1, 2};
    return {1, 2, 3};
  });
  EXPECT_EQ(value_of(result, "figure4.ordered_pairs_source"), 6);
  EXPECT_EQ(value_of(result, "figure4.specific_best_source"), 9);
  EXPECT_EQ(value_of(result, "figure4.large_worst_source"), 12);
}

TEST(Figure4Measures, OnlyThePaperNoiseAndTheFirstSubject) {
  for (const auto change :
       {+[](ExperimentKey& key) { key.subject = 2; }, +[](ExperimentKey& key) { key.noise.factor = 2; },
        +[](ExperimentKey& key) { key.noise.model = "kinect"; }}) {
    RunResult result = ordered_result();
    for (ExperimentResult& experiment : result.experiments) change(experiment.key);
    EXPECT_TRUE(figure4_measures(result).empty());
  }
}

TEST(Figure4Measures, OnlyWhenAllExperimentsAreThere) {
  RunResult result = ordered_result();
  result.experiments.pop_back();
  EXPECT_TRUE(figure4_measures(result).empty());
  const RunResult recorded = even_result(TruthKind::recorded, [](int) {
    return std::array<double, 3>{1.0, 2.0, 3.0};
  });
  EXPECT_EQ(value_of(recorded, "figure4.largest_mean_position_error_mm_recorded"), 3);
  EXPECT_EQ(value_of(recorded, "figure4.largest_mean_position_error_mm_source"), -1);
  EXPECT_EQ(value_of(recorded, "figure4.ordered_pairs_source"), -1);
}

TEST(Figure4Measures, AnExperimentThatLostEveryFrameHasNoSmallError) {
  RunResult result = ordered_result();
  ExperimentResult& lost = result.experiments.back();
  std::vector<FrameRecord> frames;
  for (int i = 0; i < kFrames; ++i) frames.push_back(example_lost_frame(i));
  lost = summarize(lost.key, {{1, frames}}, pck_curve({}, 0), {}, {.resamples = 10});
  const std::vector<Measure> measures = figure4_measures(result);
  const Measure* largest = find(measures, "figure4.largest_mean_position_error_mm_source");
  ASSERT_NE(largest, nullptr);
  EXPECT_FALSE(largest->value);
  EXPECT_FALSE(largest->interval);
  EXPECT_EQ(value_of(result, "figure4.ordered_pairs_source"), -1) << "Tr5 cannot be ordered: there is no count";
}

TEST(Figure4Measures, AMeanThatIsNoNumberIsNotIgnored) {
  for (const double mean : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    RunResult result = ordered_result();
    result.experiments[4].aggregates[metric_index("position_error_mm")].mean = mean;
    const std::vector<Measure> measures = figure4_measures(result);
    const Measure* largest = find(measures, "figure4.largest_mean_position_error_mm_source");
    ASSERT_NE(largest, nullptr);
    EXPECT_FALSE(largest->value);
    EXPECT_EQ(value_of(result, "figure4.ordered_pairs_source"), -1);
  }
}

TEST(Figure4Measures, DrawsAreSharedByTheDatabasesOfATrajectory) {
  // Errors that vary by 10 mm and differ by 0.5 mm in each frame: only shared draws keep their order.
  RunResult result = ordered_result();
  for (size_t e = 0; e < result.experiments.size(); ++e) {
    std::vector<FrameRecord> frames;
    for (int i = 0; i < kFrames; ++i) {
      const double error = 5 + i / 15 * 10 + 0.5 * static_cast<double>(e % 3);
      frames.push_back(example_frame(i, error, error, error));
    }
    result.experiments[e] =
        summarize(result.experiments[e].key, {{1, frames}}, pck_curve({}, 0), {}, {.resamples = 10});
  }
  const std::vector<Measure> measures = figure4_measures(result);
  const Measure* ordered = find(measures, "figure4.ordered_pairs_source");
  ASSERT_TRUE(ordered && ordered->interval);
  EXPECT_EQ(ordered->interval->low, 15);
  const Measure* largest = find(measures, "figure4.largest_mean_position_error_mm_source");
  ASSERT_TRUE(largest && largest->value && largest->interval);
  EXPECT_DOUBLE_EQ(*largest->value, 21) << "5 + mean of 0, 10, 20, 30 + 1";
  EXPECT_GT(largest->interval->high, 22);
  EXPECT_LE(largest->interval->high, 36) << "no frame has a larger one";
}

TEST(Figure4Measures, ExperimentsOfOtherFramesHaveNoInterval) {
  RunResult result = ordered_result();
  result.experiments[0].runs[0].frames.pop_back();
  const std::vector<Measure> measures = figure4_measures(result);
  const Measure* ordered = find(measures, "figure4.ordered_pairs_source");
  ASSERT_NE(ordered, nullptr);
  EXPECT_EQ(ordered->value, 15);
  EXPECT_FALSE(ordered->interval);
}

TEST(Figure4Measures, CurvesAreTheRecordedExperimentsOfTheFigures) {
  RunResult result;
  result.experiments.push_back(even_experiment({"Tr4", "DB_open_power", TruthKind::recorded, 1, {}}, 4, 3, 2));
  result.experiments.push_back(even_experiment({"Tr1", "DB_20_postures", TruthKind::source, 1, {}}, 7, 8, 9));
  const std::vector<Measure> measures = figure4_measures(result);
  ASSERT_EQ(measures.size(), 3u);
  EXPECT_EQ(value_of(result, "figure5.position_error_mm"), 4);
  EXPECT_EQ(value_of(result, "figure5.posture_error_deg"), 3);
  EXPECT_EQ(value_of(result, "figure5.rotation_error_deg"), 2);
  EXPECT_EQ(measures[1].unit, "deg");
  ASSERT_TRUE(measures[0].interval);
  EXPECT_EQ(*measures[0].interval, *result.experiments[0].interval_of("position_error_mm"));
}

}  // namespace
}  // namespace glovebench::reports
