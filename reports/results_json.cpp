#include "reports/results_json.h"

#include "core/base/whole_file.h"
#include "reports/commands.h"
#include "reports/statistics.h"
#include "reports/study.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

Json aggregates_json(const ExperimentResult& experiment, std::span<const std::string> metric_keys) {
  Json json = Json::object();
  for (const std::string& key : metric_keys) {
    Json& aggregate = json[key] = aggregate_json(experiment.aggregate_of(key));
    aggregate["interval"] = interval_json(experiment.interval_of(key));
  }
  return json;
}

Json or_null(std::optional<int> count) { return count ? Json(*count) : Json(); }

Json coverage_json(const Coverage& coverage, bool has_levels) {
  Json json = {{"frames", coverage.frames},
               {"covered", or_null(coverage.covered)},
               {"lost", coverage.lost},
               {"false_tracked", or_null(coverage.false_tracked)},
               {"false_lost", coverage.false_lost},
               {"share", rounded_or_null(coverage.share())}};
  if (!has_levels) return json;
  json["visible"] = coverage.visible;
  json["found"] = or_null(coverage.found);
  json["usable"] = or_null(coverage.usable);
  json["found_share"] = rounded_or_null(coverage.found_share());
  json["usable_share"] = rounded_or_null(coverage.usable_share());
  return json;
}

Json pck_json(const PckCurve& pck) {
  return {{"thresholds_mm", array_of(pck.thresholds_mm, rounded)},
          {"shares", array_of(pck.shares, rounded)},
          {"area", rounded_or_null(pck.area)}};
}

Json runs_json(const std::vector<SeedRun>& runs, std::span<const std::string> metric_keys) {
  const auto row = [&](const FrameRecord& frame) { return frame_row(frame, metric_keys); };
  return array_of(runs, [&](const SeedRun& run) -> Json {
    return {{"seed", run.seed}, {"frames", array_of(run.frames, row)}};
  });
}

Json experiment_json(const ExperimentResult& experiment, const Protocol& protocol) {
  const std::vector<std::string>& metric_keys = protocol.metric_keys;
  const ExperimentKey& key = experiment.key;
  const SequenceMetrics& sequence = experiment.sequence;
  Json json = {{"trajectory", key.trajectory},
               {"database", key.database},
               {"truth", std::string(to_string(key.truth))},
               {"subject", key.subject},
               {"noise", {{"model", key.noise.model}, {"factor", rounded(key.noise.factor)}}},
               {"coverage", coverage_json(experiment.coverage, !protocol.coverage_rules.empty())},
               {"aggregates", aggregates_json(experiment, metric_keys)},
               {"joint_pck", pck_json(experiment.pck)},
               {"sequence",
                {{"jitter_position_mm", rounded_or_null(sequence.jitter_position_mm)},
                 {"jitter_rotation_deg", rounded_or_null(sequence.jitter_rotation_deg)},
                 {"latency_frames", rounded_or_null(sequence.latency_frames)}}},
               {"runs", runs_json(experiment.runs, metric_keys)}};
  // Left out if empty, so older results keep their bytes.
  if (key.appearance != Appearance::glove) json["appearance"] = std::string(to_string(key.appearance));
  if (experiment.fingertip_pck) json["fingertip_pck"] = pck_json(*experiment.fingertip_pck);
  if (experiment.commands) json["commands"] = commands_json(*experiment.commands);
  return json;
}

}  // namespace

std::vector<std::string> frame_columns(std::span<const std::string> metric_keys) {
  std::vector<std::string> columns = {"frame",      "timestamp_us", "status",    "covered",       "false_tracked",
                                      "false_lost", "ambiguous",    "converged", "icp_iterations"};
  columns.insert(columns.end(), metric_keys.begin(), metric_keys.end());
  return columns;
}

Json frame_row(const FrameRecord& frame, std::span<const std::string> metric_keys) {
  Json row = {frame.frame,     frame.timestamp_us,  std::string(to_string(frame.status)),
              frame.covered,   frame.false_tracked, frame.false_lost,
              frame.ambiguous, frame.converged,     frame.icp_iterations};
  if (!frame.is_judged) row[3] = row[4] = nullptr;
  for (const std::string& key : metric_keys) row.push_back(rounded_or_null(frame[key]));
  return row;
}

std::string results_json(const RunResult& result) {
  Protocol protocol = result.protocol;
  std::erase_if(protocol.metric_keys, [](const std::string& key) { return !find_frame_metric(key); });
  const auto to_json = [&](const ExperimentResult& experiment) { return experiment_json(experiment, protocol); };
  Json json = {{"format", kResultsFormat},
               {"version", kResultsVersion},
               {"protocol",
                {{"id", protocol.id()},
                 {"metric_definitions", protocol.metric_definitions},
                 {"joint_order", protocol.joint_order},
                 {"metric_keys", protocol.metric_keys},
                 {"association", protocol.association}}},
               {"inputs",
                {{"truths", result.inputs.truths},
                 {"databases", result.inputs.databases},
                 {"hand_model", result.inputs.hand_model},
                 {"color_table", result.inputs.color_table}}},
               {"suite", result.suite.empty() ? Json() : Json(result.suite)},
               {"program", {{"version", result.program_version}, {"commit", result.commit}}},
               {"configuration", result.configuration},
               {"frame_columns", frame_columns(protocol.metric_keys)},
               {"experiments", array_of(result.experiments, to_json)}};
  // Left out if empty, so older results and those without studies keep their bytes.
  if (!protocol.coverage_rules.empty()) json["protocol"]["coverage_rules"] = protocol.coverage_rules;
  if (!result.studies.empty()) json["studies"] = studies_json(result.studies);
  return format_json(json);
}

void write_results(const std::string& path, const RunResult& result) { write_file(path, results_json(result)); }

}  // namespace glovebench::reports
