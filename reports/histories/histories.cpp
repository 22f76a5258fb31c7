#include "reports/histories/histories.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.h"
#include "reports/comparison/quantities.h"
#include "reports/json_text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

/// A quantity of an experiment; no value where no frame has one.
struct Measurement {
  std::optional<double> value;
  std::optional<ConfidenceInterval> interval;
  int frames = 0;  ///< that the value is from
};

Measurement share_of(const Coverage& coverage, std::string_view key) {
  if (coverage.frames == 0) return {};
  int count = coverage.false_lost;
  if (key == "uncovered_percent")
    count = coverage.frames - coverage.covered;
  else if (key == "false_tracked_percent")
    count = coverage.false_tracked;
  else
    check(key == "false_lost_percent", "coverage counts that share");
  return {100.0 * count / coverage.frames, {}, coverage.frames};
}

Measurement measure(const ExperimentResult& experiment, const Quantity& quantity) {
  if (quantity.is_share) return share_of(experiment.coverage, quantity.key);
  const Aggregate& aggregate = experiment.aggregate_of(quantity.key);
  return {aggregate.mean, experiment.intervals[metric_index(quantity.key)], aggregate.count};
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
    for (const Quantity& quantity : quantities()) {
      const Measurement measurement = measure(experiment, quantity);
      if (!measurement.value) continue;
      Json& metric = benchmarks[to_string(experiment.key)][std::string(quantity.key)];
      metric["value"] = rounded(*measurement.value);
      if (!measurement.interval) continue;
      metric["lower_value"] = rounded(measurement.interval->low);
      metric["upper_value"] = rounded(measurement.interval->high);
    }
  }
  return format_json(benchmarks);
}

std::string github_action_benchmark_json(const RunResult& result) {
  Json entries = Json::array();
  for (const ExperimentResult& experiment : result.experiments) {
    for (const Quantity& quantity : quantities()) {
      const Measurement measurement = measure(experiment, quantity);
      if (!measurement.value) continue;
      Json entry = {{"name", fmt::format("{} {}", to_string(experiment.key), quantity.key)},
                    {"unit", std::string(quantity.unit)},
                    {"value", rounded(*measurement.value)}};
      // The format knows one number: the farther bound, so that the range covers the interval.
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
