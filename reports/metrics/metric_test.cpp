#include "reports/metrics/metric.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cctype>
#include <sstream>
#include <stdexcept>

#include "reports/command_tables.h"
#include "reports/example_result.h"
#include "reports/metrics/glossary.h"
#include "reports/results_json.h"

namespace glovebench::reports {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

std::vector<std::string_view> keys_of(std::span<const Metric> metrics) {
  std::vector<std::string_view> keys;
  for (const Metric& metric : metrics) keys.push_back(metric.key);
  return keys;
}

TEST(Metrics, EachSaysWhatItIs) {
  for (const Metric& metric : metrics()) {
    std::string suffix = metric.unit == "%" ? "percent" : std::string(metric.unit);
    std::ranges::transform(suffix, suffix.begin(),
                           [](char c) { return c == '/' ? '_' : static_cast<char>(std::tolower(c)); });
    EXPECT_TRUE(metric.unit.empty() || metric.key == suffix || metric.key.ends_with("_" + suffix)) << metric.key;
    EXPECT_FALSE(metric.description.empty()) << metric.key;
    EXPECT_FALSE(metric.formula.empty()) << metric.key;
    EXPECT_FALSE(metric.averaged_over().empty()) << metric.key;
    if (!metric.gate) continue;
    EXPECT_GT(metric.gate->minimum_effect, metric.gate->tolerance) << metric.key;
  }
  EXPECT_TRUE(std::ranges::is_sorted(metrics(), {}, &Metric::place));
}

TEST(Metrics, SayWhereLostFramesGo) {
  EXPECT_EQ(metric_of("position_error_mm").averaged_over(), "mean over the tracked frames; lost ones are left out");
  EXPECT_EQ(metric_of("posture_rms_hidden_deg").averaged_over(),
            "mean over the tracked frames that have one; lost ones are left out");
  EXPECT_EQ(metric_of("matching_error_px").averaged_over(), "mean over the frames that have one, lost ones too");
  EXPECT_EQ(metric_of("uncovered_percent").averaged_over(), "mean over all frames, lost ones too");
}

TEST(Metrics, GlossaryHasAllOfThem) {
  const std::string terms = glossary_text(80), html = glossary_html();
  for (const Metric& metric : metrics()) {
    EXPECT_THAT("\n" + terms, AnyOf(HasSubstr(fmt::format("\n{}\n", metric.key)),
                                    HasSubstr(fmt::format("\n{}, compared\n", metric.key))));
    EXPECT_THAT(html, HasSubstr(fmt::format("<dt id=\"metric-{}\">", metric.key)));
  }
  std::istringstream text(terms);
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_THAT(terms, HasSubstr("rotation_error_deg, compared\n    geodesic angle between the "
                               "hands\n    angle of R'^T R\n    mean over the tracked frames"));
}

/// Whatever a report shows of an experiment as a number stands in the glossary.
TEST(Metrics, GlossaryExplainsEachHeadingOfAReport) {
  const RunResult result = small_result();
  for (const Table& table : {headline_table(result), detail_summary(result), command_stream_table(result),
                             command_intervention_table(result), command_error_table(result)}) {
    EXPECT_FALSE(table.rows.empty());
    for (size_t c = static_cast<size_t>(table.name_columns); c < table.columns.size(); ++c)
      EXPECT_TRUE(metric_in(table.columns[c])) << table.columns[c].heading;
  }
}

TEST(Metrics, GlossaryExplainsEachMetricOfTheResultsFile) {
  const nlohmann::json experiment = nlohmann::json::parse(results_json(small_result()))["experiments"][0];
  for (const auto& [key, value] : experiment["aggregates"].items()) EXPECT_TRUE(find_metric(key)) << key;
  for (const auto& [key, value] : experiment["sequence"].items()) EXPECT_TRUE(find_metric(key)) << key;
  for (const auto& [key, value] : experiment["commands"]["errors"].items())
    EXPECT_TRUE(find_metric("command_" + key)) << key;
  for (const auto& [key, value] : experiment["commands"]["jerk"].items())
    EXPECT_TRUE(find_metric("jerk_" + key)) << key;
  for (const auto& [key, value] : experiment.items())
    if (value.is_object() && value.contains("area")) {
      const std::string name = key.substr(0, key.find("_pck"));
      EXPECT_TRUE(find_metric(name + "_pck_area")) << key;
    }
}

TEST(Metrics, AColumnOfAStudyShowsItsMetric) {
  for (const auto& [key, metric] : std::vector<std::pair<std::string, std::string>>{
           {"rotation_error_deg_high", "rotation_error_deg"}, {"posture_change_deg_low", "posture_rms_deg"}}) {
    ASSERT_TRUE(metric_in({key, ""})) << key;
    EXPECT_EQ(metric_in({key, ""})->key, metric);
  }
  EXPECT_FALSE(metric_in({"mean_rank", ""}));
  EXPECT_FALSE(metric_in({"", "position mm"}));
}

TEST(Metrics, OfAnExperimentAreWhatItsResultSays) {
  const ExperimentResult tracked = small_result().experiments[0], none = small_result().experiments[2];
  const auto value = [](std::string_view key, const ExperimentResult& e) { return value_of(metric_of(key), e); };
  EXPECT_EQ(value("covered_percent", tracked), 75) << "one of four frames is lost";
  EXPECT_EQ(value("lost_frames", tracked), 1);
  EXPECT_EQ(value("latency_frames", tracked), 3);
  EXPECT_EQ(value("position_error_mm", tracked), 4);
  EXPECT_EQ(value("command_joints_deg", tracked), 4.5);
  EXPECT_EQ(value("interventions", tracked), 3);
  EXPECT_EQ(value("frames", none), 0);
  for (const char* key : {"covered_percent", "found_percent", "usable_percent", "joint_pck_area",
                          "fingertip_pck_area", "jitter_position_mm", "position_error_mm", "command_rate_hz"})
    EXPECT_EQ(value(key, none), std::nullopt) << key;
}

TEST(Metrics, OnlyThoseOfAFrameAreColumns) {
  EXPECT_EQ(std::ranges::count_if(metrics(), &Metric::is_column), std::ssize(frame_metrics()));
  for (const Metric& metric : frame_metrics())
    EXPECT_FALSE(metric.is_share() || metric.of_experiment) << metric.key;
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
