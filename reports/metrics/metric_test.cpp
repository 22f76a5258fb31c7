#include "reports/metrics/metric.h"

#include <gmock/gmock.h>

#include <sstream>
#include <stdexcept>

#include "reports/example_result.h"
#include "reports/metrics/glossary.h"

namespace glovebench::reports {
namespace {

std::vector<std::string_view> keys_of(std::span<const Metric> metrics) {
  std::vector<std::string_view> keys;
  for (const Metric& metric : metrics) keys.push_back(metric.key);
  return keys;
}

TEST(Metrics, EachSaysWhatItIs) {
  for (const Metric& metric : metrics()) {
    const std::string suffix = metric.unit == "%" ? "_percent" : "_" + std::string(metric.unit);
    EXPECT_TRUE(metric.key.ends_with(suffix)) << metric.key;
    EXPECT_FALSE(metric.description.empty()) << metric.key;
    EXPECT_FALSE(metric.formula.empty()) << metric.key;
    if (!metric.gate) continue;
    EXPECT_GT(metric.gate->minimum_effect, metric.gate->tolerance) << metric.key;
  }
  EXPECT_TRUE(std::ranges::is_sorted(metrics(), {}, &Metric::place));
}

TEST(Metrics, SayWhereLostFramesGo) {
  EXPECT_EQ(metric_of("position_error_mm").averaged_over(), "the tracked frames; lost ones are left out");
  EXPECT_EQ(metric_of("posture_rms_hidden_deg").averaged_over(),
            "the tracked frames that have one; lost ones are left out");
  EXPECT_EQ(metric_of("matching_error_px").averaged_over(), "the frames that have one, lost ones too");
  EXPECT_EQ(metric_of("uncovered_percent").averaged_over(), "all frames, lost ones too");
}

TEST(Metrics, GlossaryHasAllOfThem) {
  const Table table = glossary_table();
  EXPECT_EQ(table.rows.size(), metrics().size());
  std::istringstream text(glossary_text(80));
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_THAT(glossary_text(80),
              testing::HasSubstr("rotation_error_deg, compared\n    geodesic angle between the "
                                 "hands\n    angle of R'^T R\n    mean over the tracked frames"));
}

TEST(Metrics, SharesAreNoColumns) {
  EXPECT_EQ(frame_metrics().size() + 4, metrics().size());
  for (const Metric& metric : frame_metrics()) EXPECT_FALSE(metric.is_share()) << metric.key;
  EXPECT_EQ(FrameRecord().values.size(), frame_metrics().size());
}

// Rows of comparisons and noise floors have this order.
TEST(Metrics, NewGatedOnesComeLast) {
  EXPECT_THAT(
      keys_of(gated_metrics().first(10)),
      testing::ElementsAre("position_error_mm", "rotation_error_deg", "posture_rms_deg",
                           "posture_rms_unfiltered_deg", "vertex_error_mm", "fingertip_error_mm",
                           "uncovered_percent", "false_tracked_percent", "false_lost_percent", "icp_residual_mm"));
}

TEST(Metrics, AreFoundByKey) {
  FrameRecord frame;
  for (const Metric& metric : metrics()) EXPECT_EQ(&metric_of(metric.key), &metric);
  frame["vertex_error_mm"] = 3;
  EXPECT_EQ(frame.values[metric_index("vertex_error_mm")], 3);
  EXPECT_EQ(value_of(metric_of("vertex_error_mm"), frame), 3);
  EXPECT_THROW(metric_of("posture_error"), std::logic_error);
  EXPECT_THROW(metric_index("uncovered_percent"), std::logic_error) << "no column";
}

TEST(Metrics, SharesHaveAValueInEveryFrameAndErrorsWhereThereIsOne) {
  const FrameRecord tracked = example_frame(0, 3, 5, 2), lost = example_lost_frame(1),
                    far = example_frame(2, 60, 5, 2);
  for (const Metric& metric : gated_metrics()) {
    EXPECT_TRUE(value_of(metric, tracked)) << metric.key;
    EXPECT_EQ(value_of(metric, lost).has_value(), metric.is_share()) << metric.key;
  }
  const Metric &uncovered = metric_of("uncovered_percent"), &false_tracked = metric_of("false_tracked_percent"),
               &false_lost = metric_of("false_lost_percent");
  EXPECT_EQ(value_of(uncovered, tracked), 0);
  EXPECT_EQ(value_of(uncovered, lost), 100);
  EXPECT_EQ(value_of(false_tracked, far), 100) << "far off, and says tracked";
  EXPECT_EQ(value_of(false_tracked, lost), 0);
  EXPECT_EQ(value_of(false_lost, far), 0);
  EXPECT_EQ(value_of(false_lost, lost), 100);
}

}  // namespace
}  // namespace glovebench::reports
