#include "reports/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/file_set.h"
#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/results_json.h"
#include "reports/summary.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

struct NamedFile {
  std::string name;
  std::string content;
};

std::vector<NamedFile> other_files(const RunResult& result) {
  const PaperNumbers& paper = paper_numbers();
  const std::string run = run_name(result);
  std::vector<NamedFile> files = {{"histories/bencher.json", bencher_json(result)},
                                  {"histories/github_action_benchmark.json", github_action_benchmark_json(result)}};
  if (is_figure4(result))
    files.push_back({"tables/figure4.tex", figure4_latex(result, paper, headline_noise(result))});
  else if (!result.experiments.empty())
    files.push_back({"tables/errors.tex", errors_latex(result)});
  const auto tables = csv_tables(result, paper);
  for (const auto& [name, csv] : tables.items()) files.push_back({"tables/" + name + ".csv", csv});
  for (const ExperimentResult& experiment : result.experiments)
    files.push_back({"tables/frames_" + to_string(experiment.key) + ".csv", frames_csv(run, experiment)});
  if (!result.experiments.empty()) files.push_back({"tables/metrics.csv", metrics_csv(result)});
  if (has_commands(result)) files.push_back({"tables/commands.csv", commands_csv(result)});
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(result));
  if (any_was_run(verdicts)) {
    files.push_back({"claims.json", claims_json(verdicts)});
    files.push_back({"tables/claims.csv", claims_csv(run, verdicts)});
  }
  return files;
}

/// Names that only some reports have.
bool is_of_some_reports(const std::string& name) {
  return name.starts_with("tables/") || name.starts_with("histories/") || name.starts_with("estimates/") ||
         name == "claims.json";
}

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

std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const PageMaterial& material,
                                      const std::vector<ExperimentEstimates>& estimates) {
  const PaperNumbers& paper = paper_numbers();
  WholeFiles files(folder);
  for (const auto& [name, entry] : Manifest(files.manifest()))
    if (is_of_some_reports(name)) files.remove(name);
  files.add("config.json", format_json(result.configuration));
  files.add("summary.md", summary_markdown(result, paper, material.warnings));
  files.add("index.html", html_page(result, paper, timings, material));
  files.add("timings.json", timings_json(timings, result.studies));
  for (const NamedFile& table : other_files(result)) files.add(table.name, table.content);
  for (const ExperimentEstimates& experiment : estimates)
    files.add(estimates_file(experiment.key), estimates_csv(experiment));
  files.add("results.json", results_json(result));
  files.commit();
  return files.names();
}

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
