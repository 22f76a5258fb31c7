#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/comparison/comparison_report.h"
#include "reports/comparison/comparison_text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

Json result_json(const ComparedResult& result) {
  return {{"name", valid_utf8(result.name)},
          {"suite", result.suite.empty() ? Json() : Json(result.suite)},
          {"program", {{"version", result.program_version}, {"commit", result.commit}}}};
}

Json method_json(const Comparison& comparison) {
  const CompareConfig& config = comparison.config;
  return {{"family_error", config.family_error},
          {"block_frames", config.block_frames},
          {"resamples", config.resamples},
          {"bootstrap_seed", config.seed},
          {"seeds", comparison.seeds},
          {"other_seeds", comparison.other_seeds},
          {"has_noise_floor", comparison.has_noise_floor},
          {"preselected_metrics", comparison.preselected}};
}

Json row_json(const ComparisonRow& row) {
  const bool is_readable = shows_interval(row);
  return {{"experiment", row.experiment},
          {"quantity", row.metric->key},
          {"unit", row.metric->unit},
          {"verdict", to_string(row.verdict)},
          {"stops", stops(row)},
          {"pairs", row.pairs},
          {"frames", row.frames},
          {"blocks", row.blocks},
          {"baseline", rounded_or_null(row.baseline)},
          {"candidate", rounded_or_null(row.candidate)},
          {"difference", rounded_or_null(row.difference)},
          {"low", is_readable ? rounded_or_null(row.low) : Json()},
          {"high", is_readable ? rounded_or_null(row.high) : Json()},
          {"minimum_effect", rounded(row.minimum_effect)},
          {"enough_frames", row.enough_frames > 0 ? Json(row.enough_frames) : Json()}};
}

Json speed_row_json(const SpeedRow& row) {
  return {{"name", row.name},          {"baseline", rounded(row.baseline)}, {"candidate", rounded(row.candidate)},
          {"best", rounded(row.best)}, {"limit", rounded(row.limit)},       {"slower", row.slower}};
}

Json stage_time_json(const StageTimeChange& stage) {
  return {{"stage", stage.stage},
          {"baseline_median_ms", rounded(stage.baseline_ms)},
          {"candidate_median_ms", rounded(stage.candidate_ms)}};
}

Json changed_frame_json(const ChangedFrame& frame) {
  return {{"experiment", to_string(frame.key)},
          {"baseline_seed", frame.baseline_seed},
          {"candidate_seed", frame.candidate_seed},
          {"frame", frame.frame},
          {"baseline_vertex_error_mm", rounded_or_null(frame.baseline_vertex_error_mm)},
          {"candidate_vertex_error_mm", rounded_or_null(frame.candidate_vertex_error_mm)}};
}

Json differences_json(const FrameDifferences& experiment) {
  Json differences = Json::object();
  for (const auto& [metric, values] : experiment.differences)
    differences[std::string(metric->key)] = array_of(values, rounded_or_null);
  return {{"experiment", experiment.experiment},
          {"first_frame", experiment.first_frame},
          {"differences", std::move(differences)}};
}

/// Values are JSON texts; a missing value is null.
Json change_json(const ConfigurationChange& change) {
  const auto value = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  return {{"field", change.field}, {"baseline", value(change.baseline)}, {"candidate", value(change.candidate)}};
}

}  // namespace

std::string comparison_json(const ComparisonReport& report) {
  const Comparison& comparison = report.comparison;
  return format_json(
      {{"format", "glovebench-comparison"},
       {"version", 1},
       {"outcome", outcome_line(report)},
       {"explanation", comparison_explanation(comparison)},
       {"baseline", result_json(comparison.baseline)},
       {"candidate", result_json(comparison.candidate)},
       {"method", method_json(comparison)},
       {"rows", array_of(comparison.rows, row_json)},
       {"speed", array_of(report.speed, speed_row_json)},
       {"stage_times",
        {{"same_machine", report.times.same_machine}, {"stages", array_of(report.times.stages, stage_time_json)}}},
       {"configuration_changes", array_of(comparison.configuration, change_json)},
       {"only_in_baseline", comparison.only_in_baseline},
       {"only_in_candidate", comparison.only_in_candidate},
       {"uncompared_metrics", comparison.uncompared_metrics},
       {"worst_frames", array_of(comparison.worst, changed_frame_json)},
       {"frame_differences", array_of(comparison.frames, differences_json)}});
}

std::string comparison_csv(const ComparisonReport& report) {
  std::string csv =
      "baseline_run,candidate_run,experiment,quantity,unit,verdict,stops,pairs,frames,blocks,baseline,candidate,"
      "difference,low,high,minimum_effect,enough_frames,confidence_percent,preselected_metrics\n";
  const double confidence = rounded(report.comparison.config.confidence_percent());
  const std::string metrics = fmt::format("{}", fmt::join(report.comparison.preselected, " "));
  for (const ComparisonRow& row : report.comparison.rows) {
    const Json json = row_json(row);
    Json cells = {report.comparison.baseline.run, report.comparison.candidate.run};
    for (const auto& [key, value] : json.items()) cells.push_back(value);
    cells.insert(cells.end(), {confidence, metrics});
    csv += csv_line(cells);
  }
  return csv;
}

}  // namespace glovebench::reports
