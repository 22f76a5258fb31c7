#include "reports/results.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

TEST(Results, LostFramesStayInTheDenominator) {
  const ExperimentResult experiment = small_result().experiments[0];
  EXPECT_EQ(experiment.coverage, (Coverage{4, 3, 1, 0, 1, 4, 3, 3}));
  EXPECT_DOUBLE_EQ(*experiment.coverage.share(), 0.75);
}

TEST(Results, AggregatesAreOverTheFramesThatHaveAValue) {
  const ExperimentResult experiment = small_result().experiments[0];
  const Aggregate& position = experiment.aggregate_of("position_error_mm");  // 3, 4, 5
  EXPECT_EQ(position.count, 3);
  EXPECT_DOUBLE_EQ(*position.mean, 4);
  EXPECT_DOUBLE_EQ(*position.median, 4);
  EXPECT_DOUBLE_EQ(*position.rms, std::sqrt(50.0 / 3));
  EXPECT_DOUBLE_EQ(*position.p95, 4.9);
  EXPECT_DOUBLE_EQ(*position.max, 5);
  EXPECT_EQ(experiment.aggregate_of("posture_rms_hidden_deg"), Aggregate{});
  const auto& interval = experiment.interval_of("position_error_mm");
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->seeds, 2);
  EXPECT_GE(interval->low, 3);
  EXPECT_LE(interval->high, 5);
}

TEST(Results, OnlyLostFramesOrNoneHaveNoErrors) {
  const RunResult result = small_result();
  const ExperimentResult& lost = result.experiments[1];
  EXPECT_EQ(lost.coverage, (Coverage{2, 0, 2, 0, 2, 2, 0, 0}));
  EXPECT_EQ(lost.coverage.share(), 0.0);
  EXPECT_EQ(lost.aggregate_of("position_error_mm").mean, std::nullopt);
  const ExperimentResult& empty = result.experiments[2];
  EXPECT_EQ(empty.coverage.share(), std::nullopt) << "no frames is not 0% of them";
  EXPECT_EQ(empty.aggregate_of("rotation_error_deg").count, 0);
}

TEST(Results, FalseTrackedFramesAreNotCovered) {
  EXPECT_EQ(small_result().experiments[3].coverage, (Coverage{1, 0, 0, 1, 0, 1, 0, 0}));
}

TEST(Results, KeysNameExperimentsApart) {
  const RunResult result = small_result();
  EXPECT_EQ(to_string(result.experiments[1].key), "Tr4_DB_open_power_source_subject2_gradient_1");
  EXPECT_EQ(to_string(result.experiments[3].key), "Tr4_DB_open_power_recorded_subject1_kinect_0.5");
  EXPECT_EQ(find_experiment(result, result.experiments[3].key), &result.experiments[3]);
  EXPECT_EQ(find_experiment(result, {"Tr2", "DB_open_pinch", TruthKind::source, 1, {}}), nullptr);
  EXPECT_THROW(metric_index("posture_error"), std::logic_error);
}

TEST(Results, HeadlineNoiseIsThePapersWhereThatWasRun) {
  RunResult result = small_result();
  EXPECT_EQ(headline_noise(result), (NoiseSetting{"gradient", 1}));
  result.experiments.erase(result.experiments.begin(), result.experiments.begin() + 3);
  EXPECT_EQ(headline_noise(result), (NoiseSetting{"kinect", 0.5}));
  result.experiments.clear();
  EXPECT_EQ(headline_noise(result), NoiseSetting{});
}

TEST(Results, ProtocolIdOfTheFirstMetricsStays) {
  Protocol protocol = make_protocol("by time stamp, exact");
  protocol.metric_keys.resize(14);
  protocol.coverage_rules.clear();
  EXPECT_EQ(protocol.id(), "59e61f1861e6abcb27e87148dcac07cb") << "the id of the baselines";
}

TEST(Results, ProtocolIdChangesWithWhateverItCovers) {
  const Protocol protocol = make_protocol("by time stamp, exact");
  EXPECT_EQ(protocol.joint_order.size(), 22u);
  EXPECT_EQ(protocol.id(), make_protocol("by time stamp, exact").id());
  Protocol other = protocol;
  other.metric_definitions = 2;
  EXPECT_NE(other.id(), protocol.id());
  other = protocol;
  std::swap(other.joint_order[3], other.joint_order[4]);
  EXPECT_NE(other.id(), protocol.id());
  EXPECT_NE(make_protocol("nearest").id(), protocol.id());
  for (const auto& [rule, value] : protocol.coverage_rules) {
    other = protocol;
    other.coverage_rules[rule] += 1;
    EXPECT_NE(other.id(), protocol.id()) << rule;
  }
}

}  // namespace
}  // namespace glovebench::reports
