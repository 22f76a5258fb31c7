#include "reports/histories/histories.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/json_text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

/// A metric of an experiment; empty where no frame has one.
struct Measurement {
  std::optional<double> value;
  std::optional<ConfidenceInterval> interval;
  int frames = 0;  ///< with a value
};

Measurement share_of(const std::vector<SeedRun>& runs, const Metric& metric) {
  std::vector<double> values;
  for (const SeedRun& run : runs)
    for (const FrameRecord& frame : run.frames)
      if (const auto value = value_of(metric, frame)) values.push_back(*value);
  return {mean(values), {}, static_cast<int>(values.size())};
}

Measurement measure(const ExperimentResult& experiment, const Metric& metric) {
  if (metric.is_share()) return share_of(experiment.runs, metric);
  const Aggregate& aggregate = experiment.aggregate_of(metric.key);
  return {aggregate.mean, experiment.interval_of(metric.key), aggregate.count};
}

std::string extra_text(const Measurement& measurement, int frames) {
  std::string text = fmt::format("{} of {} frames", measurement.frames, frames);
  if (const auto& interval = measurement.interval)
    text += fmt::format("\n{:g}% interval {:.3f} to {:.3f}\nover {}", 100 * interval->level, interval->low,
                        interval->high, interval->over);
  return text;
}

}  // namespace

std::string bencher_json(const RunResult& result) {
  Json benchmarks = Json::object();
  for (const ExperimentResult& experiment : result.experiments) {
    for (const Metric& metric : gated_metrics()) {
      const Measurement measurement = measure(experiment, metric);
      if (!measurement.value) continue;
      Json& entry = benchmarks[to_string(experiment.key)][std::string(metric.key)];
      entry["value"] = rounded(*measurement.value);
      if (!measurement.interval) continue;
      entry["lower_value"] = rounded(measurement.interval->low);
      entry["upper_value"] = rounded(measurement.interval->high);
    }
  }
  return format_json(benchmarks);
}

std::string github_action_benchmark_json(const RunResult& result) {
  Json entries = Json::array();
  for (const ExperimentResult& experiment : result.experiments) {
    for (const Metric& metric : gated_metrics()) {
      const Measurement measurement = measure(experiment, metric);
      if (!measurement.value) continue;
      Json entry = {{"name", fmt::format("{} {}", to_string(experiment.key), metric.key)},
                    {"unit", std::string(metric.unit)},
                    {"value", rounded(*measurement.value)}};
      // The format has one number for the range: the farther bound, so that the range covers the interval.
      if (const auto& interval = measurement.interval)
        entry["range"] = fmt::format(
            "± {:.3f}", std::max(interval->high - *measurement.value, *measurement.value - interval->low));
      entry["extra"] = extra_text(measurement, experiment.coverage.frames);
      entries.push_back(std::move(entry));
    }
  }
  return format_json(entries);
}

}  // namespace glovebench::reports
