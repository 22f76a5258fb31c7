#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "reports/commands.h"
#include "reports/metrics/coverage.h"
#include "reports/results_json.h"
#include "reports/statistics.h"
#include "reports/study.h"

namespace glovebench::reports {
namespace {

std::optional<double> read_value(const JsonCursor& json) { return json.number_or_null(0, kLargestError); }

std::vector<std::string> read_texts(const JsonCursor& json) {
  std::vector<std::string> texts;
  for (const JsonCursor& item : json.items()) texts.push_back(item.text());
  return texts;
}

std::vector<double> read_numbers(const JsonCursor& json, double max) {
  std::vector<double> numbers;
  for (const JsonCursor& item : json.items()) numbers.push_back(item.number(0, max));
  return numbers;
}

/// Shares that were counted by other rules do not mean the same.
std::map<std::string, double> read_coverage_rules(const JsonCursor& json) {
  const std::map<std::string, double> rules = coverage_rules();
  for (const auto& [name, found] : json.members())
    if (!rules.contains(name)) found.fail("a rule that this program knows");
  for (const auto& [name, expected] : rules) {
    const double found = json[name].number(0, kLargestError);
    if (found != expected)
      throw Incomparable(json[name].place() + fmt::format(": found {}, expected {}", found, expected));
  }
  return rules;
}

Protocol read_protocol(const JsonCursor& json) {
  json.expect_keys({"id", "metric_definitions", "joint_order", "metric_keys", "association"}, {"coverage_rules"});
  Protocol protocol;
  protocol.metric_definitions = json["metric_definitions"].count();
  protocol.joint_order = read_texts(json["joint_order"]);
  std::set<std::string> known;  // a file may hold millions
  for (const JsonCursor& key : json["metric_keys"].items()) {
    if (!known.insert(key.name()).second) key.fail("each metric once");
    protocol.metric_keys.push_back(key.name());
  }
  protocol.association = json["association"].text();
  if (json.has("coverage_rules")) protocol.coverage_rules = read_coverage_rules(json["coverage_rules"]);
  const JsonCursor id = json["id"];
  if (id.text() != protocol.id())
    throw Incomparable(id.place() + ": found " + quoted_excerpt(id.text()) + ", expected " + protocol.id());
  return protocol;
}

std::map<std::string, std::string> read_hashes(const JsonCursor& json) {
  std::map<std::string, std::string> hashes;
  for (const auto& [name, hash] : json.members()) hashes[name] = hash.text();
  return hashes;
}

InputHashes read_inputs(const JsonCursor& json) {
  json.expect_keys({"truths", "databases", "hand_model", "color_table"});
  return {read_hashes(json["truths"]), read_hashes(json["databases"]), json["hand_model"].text(),
          json["color_table"].text()};
}

constexpr size_t kFirstMetric = 9;

/// A metric of the file, in the file's order, with its index in frame_metrics() if the program knows it.
struct FileMetric {
  std::string key;
  std::optional<size_t> index;
};
using FileMetrics = std::vector<FileMetric>;

FileMetrics read_metrics(const JsonCursor& columns, const std::vector<std::string>& metric_keys) {
  if (read_texts(columns) != frame_columns(metric_keys))
    columns.fail("those of a frame, then protocol.metric_keys");
  FileMetrics metrics;
  for (const std::string& key : metric_keys) metrics.push_back({key, find_frame_metric(key)});
  return metrics;
}

/// Checks that rows are as long as a frame's, before memory for as many frames is reserved.
JsonItems read_rows(const JsonCursor& json, const FileMetrics& metrics) {
  JsonItems rows = json.items();
  for (const JsonCursor& row : rows)
    if (row.items().size() != kFirstMetric + metrics.size()) row.fail("one value for each of frame_columns");
  return rows;
}

/// By metric, whether some frame of an experiment has it. Estimates have it in all tracked frames or in none.
using Given = std::vector<bool>;

Given given_metrics(const JsonCursor& runs, const FileMetrics& metrics) {
  Given given(metrics.size());
  for (const JsonCursor& run : runs.items())
    for (const JsonCursor& row : read_rows(run["frames"], metrics))
      for (size_t m = 0; m < metrics.size(); ++m)
        if (!row.value()[kFirstMetric + m].is_null()) given[m] = true;
  return given;
}

/// A frame's flags follow from its errors, so dropped or changed errors are found.
void check_errors(const JsonItems& row, const FileMetrics& metrics, const FrameRecord& frame, const Given& given) {
  constexpr double kRounding = 1e-6;  // errors are rounded, so one at the bound may exceed it
  const bool is_tracked = frame.status == TrackStatus::tracked;
  for (size_t m = 0; m < metrics.size(); ++m) {
    if (!metrics[m].index) continue;
    const Metric& metric = frame_metrics()[*metrics[m].index];
    const bool is_empty = !frame.values[*metrics[m].index];
    if (!metric.of_tracked) continue;
    if (is_tracked && given[m] && !metric.is_partial && is_empty)
      row[kFirstMetric + m].fail("a number, since the frame is tracked");
    if (!is_tracked && !is_empty) row[kFirstMetric + m].fail("null, since the frame is lost");
  }
  // An error that the file lacks contradicts nothing.
  const auto is_covered = [&](double slack) {
    return is_tracked && frame["position_error_mm"].value_or(0) < kFoundPosition_mm + slack &&
           frame["rotation_error_deg"].value_or(0) < kFoundRotation_deg + slack;
  };
  const bool has_both = frame["position_error_mm"] && frame["rotation_error_deg"];
  if (frame.is_judged && (frame.covered ? !is_covered(kRounding) : has_both && is_covered(-kRounding)))
    row[3].fail(fmt::format("{}, as the errors say", !frame.covered));
  if (frame.is_judged && frame.false_tracked != (is_tracked && !frame.covered))
    row[4].fail(fmt::format("{}, as status and covered say", !frame.false_tracked));
  if (!frame.is_judged && has_both) row[3].fail("true or false, since the frame has a pose");
  if (frame.false_lost && is_tracked) row[5].fail("false, since the frame is tracked");
}

FrameRecord read_frame(const JsonCursor& json, const FileMetrics& metrics, const Given& given) {
  const JsonItems row = json.items();
  FrameRecord frame;
  frame.frame = row[0].count();
  frame.timestamp_us = row[1].integer(std::numeric_limits<int64_t>::min(), std::numeric_limits<int64_t>::max());
  frame.status = row[2].one_of<TrackStatus>();
  frame.is_judged = !row[3].is_null() || !row[4].is_null();
  frame.covered = frame.is_judged && row[3].boolean();
  frame.false_tracked = frame.is_judged && row[4].boolean();
  frame.false_lost = row[5].boolean();
  frame.ambiguous = row[6].boolean();
  frame.converged = row[7].boolean();
  frame.icp_iterations = row[8].count();
  for (size_t m = 0; m < metrics.size(); ++m) {
    const std::optional<double> value = read_value(row[kFirstMetric + m]);
    if (metrics[m].index) frame.values[*metrics[m].index] = value;
  }
  check_errors(row, metrics, frame, given);
  return frame;
}

/// Checks that frames are in order and equal those of the first run. Whether a frame is missing is checked in
/// comparison/pairing.h.
void check_frame(const JsonCursor& json, const std::vector<FrameRecord>& before, const FrameRecord& frame,
                 const std::vector<SeedRun>& runs) {
  if (!before.empty() && frame.frame <= before.back().frame)
    json.fail("a frame after " + std::to_string(before.back().frame));
  if (!before.empty() && frame.timestamp_us <= before.back().timestamp_us)
    json.fail("a time stamp after " + std::to_string(before.back().timestamp_us));
  if (runs.empty() || runs.front().frames.size() <= before.size()) return;
  const FrameRecord& first = runs.front().frames[before.size()];
  if (frame.frame != first.frame || frame.timestamp_us != first.timestamp_us)
    json.fail("the frame and time stamp of the first seed");
}

std::vector<SeedRun> read_runs(const JsonCursor& json, const FileMetrics& metrics) {
  std::vector<SeedRun> runs;
  for (const JsonCursor& item : json.items()) item.expect_keys({"seed", "frames"});
  const Given given = given_metrics(json, metrics);
  for (const JsonCursor& item : json.items()) {
    SeedRun run;
    run.seed = item["seed"].unsigned_integer();
    if (std::ranges::find(runs, run.seed, &SeedRun::seed) != runs.end()) item["seed"].fail("each seed once");
    const JsonItems rows = read_rows(item["frames"], metrics);
    run.frames.reserve(rows.size());
    for (const JsonCursor& row : rows) {
      const FrameRecord frame = read_frame(row, metrics, given);
      check_frame(row, run.frames, frame, runs);
      run.frames.push_back(frame);
    }
    if (!runs.empty() && run.frames.size() != runs.front().frames.size())
      item["frames"].fail(fmt::format("an array of {}, as the first seed has", runs.front().frames.size()));
    runs.push_back(std::move(run));
  }
  return runs;
}

std::optional<int> count_or_null(const JsonCursor& json) {
  return json.is_null() ? std::nullopt : std::optional(json.count());
}

Coverage read_coverage(const JsonCursor& json) {
  constexpr auto kLevels =
      std::to_array<std::string_view>({"visible", "found", "usable", "found_share", "usable_share"});
  json.expect_keys(
      std::to_array<std::string_view>({"frames", "covered", "lost", "false_tracked", "false_lost", "share"}),
      kLevels);
  json["share"].number_or_null(0, 1);
  Coverage coverage = {json["frames"].count(), count_or_null(json["covered"]), json["lost"].count(),
                       count_or_null(json["false_tracked"]), json["false_lost"].count()};
  if (std::ranges::none_of(kLevels, [&](std::string_view key) { return json.has(key); })) return coverage;
  coverage.visible = json["visible"].count();
  coverage.found = count_or_null(json["found"]);
  coverage.usable = count_or_null(json["usable"]);
  json["found_share"].number_or_null(0, 1);
  json["usable_share"].number_or_null(0, 1);
  return coverage;
}

PckCurve read_pck(const JsonCursor& json) {
  json.expect_keys({"thresholds_mm", "shares", "area"});
  PckCurve pck = {read_numbers(json["thresholds_mm"], kLargestError), read_numbers(json["shares"], 1),
                  json["area"].number_or_null(0, 1)};
  if (pck.shares.size() != pck.thresholds_mm.size()) json["shares"].fail("one for each threshold");
  return pck;
}

/// A mean that does not follow from its frames was changed by hand, or the frames were.
void check_aggregate(const JsonCursor& json, const Aggregate& aggregate, size_t metric,
                     const std::vector<SeedRun>& runs) {
  constexpr double kRounding = 2e-6;  // frames and mean are written to 1e-6
  std::vector<double> values;
  for (const SeedRun& run : runs)
    for (const FrameRecord& frame : run.frames)
      if (const std::optional<double>& value = frame.values[metric]) values.push_back(*value);
  if (aggregate.count != static_cast<int>(values.size()))
    json["count"].fail(fmt::format("{}, the frames that have it", values.size()));
  const std::optional<double> expected = mean(values);
  const bool agrees = aggregate.mean.has_value() == expected.has_value() &&
                      (!expected || std::abs(*aggregate.mean - *expected) <= kRounding);
  if (!agrees) json["mean"].fail("the mean of the frames in runs");
}

void read_aggregates(const JsonCursor& json, const FileMetrics& metrics, ExperimentResult& experiment) {
  if (json.members().size() != metrics.size()) json.fail(fmt::format("{} metrics", metrics.size()));
  for (const auto& [key, index] : metrics) {
    const JsonCursor item = json[key];
    item.expect_keys({"count", "mean", "median", "rms", "p95", "max", "interval"});
    const Aggregate aggregate = read_aggregate(item);
    const std::optional<ConfidenceInterval> interval = read_interval(item["interval"], 0, kLargestError);
    if (!index) continue;
    check_aggregate(item, aggregate, *index, experiment.runs);
    experiment.aggregates[*index] = aggregate;
    experiment.intervals[*index] = interval;
  }
}

ExperimentKey read_experiment_key(const JsonCursor& json) {
  json["noise"].expect_keys({"model", "factor"});
  ExperimentKey key;
  key.trajectory = json["trajectory"].name();
  key.database = json["database"].name();
  key.truth = json["truth"].one_of<TruthKind>();
  key.subject = json["subject"].count();
  key.noise = {json["noise"]["model"].name(), json["noise"]["factor"].number(0, kLargestError)};
  if (json.has("appearance")) key.appearance = json["appearance"].one_of<Appearance>();
  return key;
}

ExperimentResult read_experiment(const JsonCursor& json, const FileMetrics& metrics) {
  json.expect_keys({"trajectory", "database", "truth", "subject", "noise", "coverage", "aggregates", "joint_pck",
                    "sequence", "runs"},
                   {"appearance", "commands", "fingertip_pck"});
  json["sequence"].expect_keys({"jitter_position_mm", "jitter_rotation_deg", "latency_frames"});
  ExperimentResult experiment;
  experiment.key = read_experiment_key(json);
  experiment.runs = read_runs(json["runs"], metrics);
  experiment.coverage = read_coverage(json["coverage"]);
  if (experiment.coverage != count_coverage(experiment.runs))
    json["coverage"].fail("the counts of the frames in runs");
  read_aggregates(json["aggregates"], metrics, experiment);
  experiment.pck = read_pck(json["joint_pck"]);
  if (json.has("fingertip_pck")) experiment.fingertip_pck = read_pck(json["fingertip_pck"]);
  const JsonCursor sequence = json["sequence"];
  experiment.sequence = {read_value(sequence["jitter_position_mm"]), read_value(sequence["jitter_rotation_deg"]),
                         sequence["latency_frames"].number_or_null(-kLargestError, kLargestError)};
  if (json.has("commands")) {
    experiment.commands = read_commands(json["commands"]);
    if (experiment.commands->frames != experiment.coverage.frames)
      json["commands"]["frames"].fail("the frames in runs");
  }
  return experiment;
}

}  // namespace

RunResult read_results(const std::string& path) { return parse_results(read_file(path, kLargestResults), path); }

RunResult parse_results(const std::string& text, const std::string& where) {
  nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format(kResultsFormat, kResultsVersion);
  const bool has_studies = json.has("studies");
  json.expect_keys({"format", "version", "protocol", "inputs", "suite", "program", "configuration", "frame_columns",
                    "experiments", has_studies ? "studies" : "experiments"});
  json["program"].expect_keys({"version", "commit"});
  RunResult result;
  result.protocol = read_protocol(json["protocol"]);
  const FileMetrics metrics = read_metrics(json["frame_columns"], result.protocol.metric_keys);
  result.inputs = read_inputs(json["inputs"]);
  if (!json["suite"].is_null()) result.suite = json["suite"].name();
  result.program_version = json["program"]["version"].text();
  result.commit = json["program"]["commit"].text();
  json["configuration"].members();
  for (const JsonCursor& item : json["experiments"].items()) {
    ExperimentResult experiment = read_experiment(item, metrics);
    if (find_experiment(result, experiment.key)) item.fail("each experiment once");
    result.experiments.push_back(std::move(experiment));
  }
  if (has_studies) result.studies = read_studies(json["studies"]);
  result.configuration = std::move(document["configuration"]);  // may be large, so it is moved
  return result;
}

}  // namespace glovebench::reports
