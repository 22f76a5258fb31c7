#pragma once

#include <cmath>

#include "core/base/random.h"
#include "reports/comparison/comparison_report.h"

namespace glovebench::reports {

inline ComparisonRow example_row(const std::string& experiment, std::string_view metric, double baseline,
                                 double difference, double reach, Verdict verdict) {
  ComparisonRow row;
  row.experiment = experiment;
  row.metric = &metric_of(metric);
  row.pairs = row.frames = 234;
  row.blocks = 14;
  row.baseline = baseline;
  row.candidate = baseline + difference;
  row.difference = difference;
  row.low = difference - reach;
  row.high = difference + reach;
  row.minimum_effect = row.metric->is_share() ? 1 : 0.1;
  row.verdict = verdict;
  return row;
}

/// Each verdict once, and a metric without value.
inline ComparisonReport small_comparison() {
  const std::string experiment = "Tr4_DB_open_power_source_subject1_gradient_1";
  ComparisonReport report;
  Comparison& comparison = report.comparison;
  comparison.baseline = {"ci/baselines/quick", "0.1.0", "105ec9a", "quick", "105ec9a-01234567"};
  comparison.candidate = {"out", "0.1.0", "82ad045", "quick", "82ad045-89abcdef"};
  comparison.seeds = 2;
  comparison.rows = {example_row(std::string(kAllExperiments), "position_error_mm", 3, 0.25, 0.125, Verdict::worse),
                     example_row(experiment, "position_error_mm", 3, 0.5, 0.25, Verdict::worse),
                     example_row(experiment, "rotation_error_deg", 4, -0.5, 0.25, Verdict::better),
                     example_row(experiment, "posture_rms_deg", 6, 0.01, 0.02, Verdict::same),
                     example_row(experiment, "uncovered_percent", 1, 2, 4, Verdict::not_enough_data)};
  ComparisonRow none;
  none.experiment = experiment;
  none.metric = &metric_of("posture_rms_unfiltered_deg");
  none.frames = 234;
  comparison.rows.insert(comparison.rows.begin() + 4, none);
  comparison.worst = {{{"Tr4", "DB_open_power", TruthKind::source, 1, {}}, 1, 1, 57, 3.5, std::nullopt}};
  comparison.configuration = {{"icp.max_iterations", "30", "3"}, {"segmentation.extra", "", "\"a|b\""}};
  comparison.frames = {{experiment, 5, {}}};
  for (const Metric& metric : gated_metrics()) comparison.frames[0].differences.push_back({&metric, {}});
  comparison.frames[0].differences[0].values = {0.5, std::nullopt, -0.25};
  report.speed = {{"look_up", 8, 7.5, 8.5, 4, false}, {"align", 4, 1.5, 1.9, 2, true}};
  return report;
}

inline std::vector<std::optional<double>> example_differences(const std::string& name, size_t metric, double level,
                                                              bool loses_frames) {
  std::vector<std::optional<double>> values;
  RandomStream random(1, name, static_cast<int>(metric), "example");
  for (int i = 0; i < 117; ++i) {
    if (gated_metrics()[metric].is_share()) {
      values.push_back(loses_frames && gated_metrics()[metric].key == "uncovered_percent" && i > 60 && i < 66 ? 100
                                                                                                              : 0);
    } else if (loses_frames && i > 60 && i < 66) {
      values.push_back(std::nullopt);
    } else {
      values.push_back(level * (i < 40 ? 0.2 : 1.5 * std::exp(-(i - 40) / 60.0)) + 0.1 * random.normal());
    }
  }
  return values;
}

inline void append_example_experiment(Comparison& comparison, const ExperimentKey& key, double level,
                                      bool loses_frames) {
  const std::string name = to_string(key);
  FrameDifferences frames{name, 0, {}};
  for (size_t m = 0; m < gated_metrics().size(); ++m) {
    const Metric& metric = gated_metrics()[m];
    const auto& values =
        frames.differences
            .emplace_back(FrameDifferences::OfMetric{&metric, example_differences(name, m, level, loses_frames)})
            .values;
    double sum = 0;
    int count = 0;
    for (const auto& value : values) {
      sum += value.value_or(0);
      count += value.has_value();
    }
    const bool is_share = metric.is_share();
    const double mean = sum / count, reach = is_share ? 6 * mean : 0.06 + std::abs(mean) / 4;
    const double minimum = is_share ? 1 : 0.1;
    Verdict verdict = Verdict::not_enough_data;
    if (mean - reach > 0 && mean > minimum) verdict = Verdict::worse;
    if (mean + reach < 0 && mean < -minimum) verdict = Verdict::better;
    if (mean - reach > -minimum && mean + reach < minimum) verdict = Verdict::same;
    comparison.rows.push_back(example_row(name, metric.key, is_share ? 1 : 3, mean, reach, verdict));
    comparison.rows.back().pairs = 2 * count;
  }
  comparison.frames.push_back(std::move(frames));
}

inline ComparisonReport full_comparison() {
  ComparisonReport report = small_comparison();
  Comparison& comparison = report.comparison;
  comparison.frames.clear();
  comparison.rows.clear();
  for (const Metric& metric : gated_metrics()) {
    const bool is_position = metric.key == "position_error_mm";
    comparison.rows.push_back(example_row(std::string(kAllExperiments), metric.key, 3, is_position ? 0.2 : 0.01,
                                          0.05, is_position ? Verdict::worse : Verdict::same));
  }
  const auto source = TruthKind::source;
  append_example_experiment(comparison, {"Tr4", "DB_open_power", source, 1, {}}, 0.9, false);
  append_example_experiment(comparison, {"Tr1", "DB_20_postures", source, 1, {}}, -0.7, false);
  append_example_experiment(comparison, {"Tr5", "DB_open_power", source, 2, {}}, 0, false);
  append_example_experiment(comparison, {"Exit", "DB_open_power", source, 1, {}}, 0.1, true);
  comparison.worst.push_back({{"Exit", "DB_open_power", source, 1, {}}, 2, 2, 64, 4.25, 31.5});
  comparison.only_in_candidate = {"Tr4_DB_open_power_source_subject1_kinect_1"};
  comparison.uncompared_metrics = {{"mood_deg", "not in the baseline"}};
  return report;
}

}  // namespace glovebench::reports
