#include "reports/metrics/metric.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "core/base/error.h"
#include "reports/results.h"

namespace glovebench::reports {

std::span<const std::vector<Metric>> metric_files();  // generated

namespace {

std::vector<Metric> sorted_metrics() {
  std::vector<Metric> all;
  for (const std::vector<Metric>& file : metric_files()) all.insert(all.end(), file.begin(), file.end());
  std::ranges::sort(all, {}, [](const Metric& metric) { return std::tuple(metric.place, metric.key); });
  for (const Metric& metric : all) {
    check(std::ranges::count(all, metric.key, &Metric::key) == 1, "each metric has a key of its own");
    check(!!metric.of_tracked + !!metric.of_any + !!metric.of_record + !!metric.of_experiment == 1,
          "a metric has one function");
  }
  return all;
}

template <typename Condition>
std::vector<Metric> metrics_if(Condition condition) {
  std::vector<Metric> chosen;
  std::ranges::copy_if(metrics(), std::back_inserter(chosen), condition);
  return chosen;
}

}  // namespace

std::string_view Metric::averaged_over() const {
  if (of_experiment) return over;
  if (is_share())
    return of_column.empty() ? "mean over all frames, lost ones too"
                             : "mean over the visible frames, lost ones too";
  if (of_any) return "mean over the frames that have one, lost ones too";
  return is_partial ? "mean over the tracked frames that have one; lost ones are left out"
                    : "mean over the tracked frames; lost ones are left out";
}

std::span<const Metric> metrics() {
  static const std::vector<Metric> all = sorted_metrics();
  return all;
}

std::span<const Metric> frame_metrics() {
  static const std::vector<Metric> columns = metrics_if([](const Metric& metric) { return metric.is_column(); });
  return columns;
}

std::vector<std::string> frame_metric_keys() {
  std::vector<std::string> keys;
  for (const Metric& metric : frame_metrics()) keys.emplace_back(metric.key);
  return keys;
}

std::span<const Metric> gated_metrics() {
  static const std::vector<Metric> gated = metrics_if([](const Metric& metric) { return metric.gate.has_value(); });
  return gated;
}

const Metric* find_metric(std::string_view key) {
  const auto found = std::ranges::find(metrics(), key, &Metric::key);
  return found == metrics().end() ? nullptr : &*found;
}

const Metric& metric_of(std::string_view key) {
  const Metric* found = find_metric(key);
  check(found != nullptr, "a metric of that key exists");
  return *found;
}

size_t metric_index(std::string_view key) {
  const std::optional<size_t> index = find_frame_metric(key);
  check(index.has_value(), "a metric of that key is a column");
  return *index;
}

std::optional<size_t> find_frame_metric(std::string_view key) {
  const auto found = std::ranges::find(frame_metrics(), key, &Metric::key);
  if (found == frame_metrics().end()) return {};
  return static_cast<size_t>(found - frame_metrics().begin());
}

std::optional<double> value_of(const Metric& metric, const FrameRecord& frame) {
  if (!metric.is_share()) return frame[metric.key];
  const std::optional<bool> answer = metric.of_record(frame);
  if (!answer) return {};
  return *answer ? 100 : 0;
}

std::optional<double> value_of(const Metric& metric, const ExperimentResult& experiment) {
  return metric.of_experiment ? metric.of_experiment(experiment) : experiment.aggregate_of(metric.key).mean;
}

}  // namespace glovebench::reports
