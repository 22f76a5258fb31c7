#include "reports/comparison/comparison_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/base/text.h"

namespace glovebench::reports {
namespace {

constexpr std::string_view kWorseInPlaces = "worse in places";

/// Three digits if they fit, else fewer.
std::string formatted(double value) {
  const double magnitude = std::abs(value);
  if (magnitude >= 99999.5) return fmt::format("{:.2e}", value);
  return fmt::format("{:.{}f}", magnitude < 0.0005 ? 0.0 : value, magnitude < 999.9995 ? 3 : 1);  // no minus zero
}

std::string formatted_signed(double value) {
  const std::string text = formatted(value);
  return text.starts_with('-') ? text : "+" + text;
}

/// Of rows that are worth reading.
Table enough_table(const Comparison& comparison) {
  Table table = table_of({"experiment", "quantity", "enough would be"}, 3);
  table.title = "Not enough data";
  table.explanation =
      "What would be enough for a verdict if further movements vary as these do. More seeds of the same movements "
      "do not replace them.";
  for (const ComparisonRow& row : comparison.rows)
    if (const std::string enough = enough_text(row, comparison.config); !enough.empty() && is_worth_reading(row))
      table.rows.push_back({readable_experiment(row.experiment), std::string(row.metric->key), enough});
  return table;
}

Table speed_table(const std::vector<SpeedRow>& speed) {
  Table table = table_of({"times faster than plain", "baseline", "candidate", "at best", "limit", "verdict"});
  table.title = "Speed";
  for (const SpeedRow& row : speed)
    table.rows.push_back({row.name, row.baseline, row.candidate, row.best, row.limit,
                          row.slower ? Judgment{"slower", Tone::worse} : Judgment{"as fast", Tone::same}});
  return table;
}

Table configuration_table(const std::vector<ConfigurationChange>& changes) {
  Table table = table_of({"configuration", "baseline", "candidate"}, 3);
  table.title = "Configuration";
  for (const ConfigurationChange& change : changes)
    table.rows.push_back({change.field, change.baseline.empty() ? "-" : change.baseline,
                          change.candidate.empty() ? "-" : change.candidate});
  return table;
}

Table uncompared_table(const Comparison& comparison) {
  Table table = table_of({"not compared", "why"}, 2);
  table.title = "Not compared";
  for (const std::string& name : comparison.only_in_baseline) table.rows.push_back({name, "only in the baseline"});
  for (const std::string& name : comparison.only_in_candidate)
    table.rows.push_back({name, "only in the candidate"});
  for (const auto& [metric, why] : comparison.uncompared_metrics) table.rows.push_back({metric, why});
  return table;
}

Table times_table(const StageTimeChanges& times) {
  Table table = table_of({"median time of a stage", "baseline (ms)", "candidate (ms)"});
  table.title = "Times";
  table.explanation =
      times.same_machine
          ? "Processor times of the same processor and number of threads, for information: other work slows them."
          : "Processor times of different processors or numbers of threads, for information only.";
  for (const StageTimeChange& stage : times.stages)
    table.rows.push_back({stage.stage, stage.baseline_ms, stage.candidate_ms});
  return table;
}

}  // namespace

std::vector<OutcomeCount> outcome_counts(const Comparison& comparison) {
  const auto count = [&](Verdict verdict) {
    return std::ranges::count(comparison.rows, verdict, &ComparisonRow::verdict);
  };
  const long in_places = std::ranges::count_if(comparison.rows, is_worse_in_places);
  std::vector<OutcomeCount> counts = {{count(Verdict::worse), "worse", Tone::worse}};
  if (in_places > 0) counts.push_back({in_places, std::string(kWorseInPlaces), Tone::worse});
  counts.push_back({count(Verdict::better), "better", Tone::better});
  counts.push_back({count(Verdict::same), "same", Tone::same});
  counts.push_back({count(Verdict::not_enough_data) - in_places, "not enough data", Tone::unsure});
  return counts;
}

std::string outcome_line(const ComparisonReport& report) {
  std::string line;
  for (const OutcomeCount& part : outcome_counts(report.comparison))
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", part.count, part.verdict);
  const std::vector<ComparisonRow>& rows = report.comparison.rows;
  if (!rows.empty() && std::ranges::all_of(rows, &ComparisonRow::is_equal)) line += "; equal in every frame";
  if (!report.speed.empty())
    line += fmt::format("; {} of {} speed ratios slower", std::ranges::count(report.speed, true, &SpeedRow::slower),
                        report.speed.size());
  return line;
}

bool is_worth_reading(const ComparisonRow& row) {
  const bool unchanged = row.verdict == Verdict::same || (row.difference && *row.difference == 0);
  return !unchanged || stops(row);
}

std::vector<std::span<const ComparisonRow>> rows_by_experiment(const Comparison& comparison) {
  std::vector<std::span<const ComparisonRow>> groups;
  const std::span<const ComparisonRow> rows = comparison.rows;
  for (size_t begin = 0, end; begin < rows.size(); begin = end) {
    for (end = begin + 1; end < rows.size() && rows[end].experiment == rows[begin].experiment;) ++end;
    groups.push_back(rows.subspan(begin, end - begin));
  }
  return groups;
}

std::string readable_experiment(const std::string& experiment) {
  if (experiment == kAllExperiments) return "all experiments";
  const std::vector<std::string_view> parts = split(experiment, '_');
  if (parts.size() < 6) return experiment;
  // Counted from the end, since names of trajectories and databases may contain underscores.
  const auto tail = parts.end() - 4;
  const std::string_view truth = tail[0], subject = tail[1], noise = tail[2], factor = tail[3];
  if ((truth != "source" && truth != "recorded") || !subject.starts_with("subject")) return experiment;
  std::string name = fmt::format("{}", fmt::join(parts.begin(), tail, "_"));
  if (const size_t database = name.find("_DB_"); database != std::string::npos)
    name = fmt::format("{} {}", name.substr(0, database), name.substr(database + 4));
  name += fmt::format(", {}", truth);
  if (subject != "subject1") name += fmt::format(", subject {}", subject.substr(7));
  if (noise != "gradient" || factor != "1") name += fmt::format(", {} x {}", noise, factor);
  return name;
}

std::string interval_text(const ComparisonRow& row) {
  if (row.verdict == Verdict::not_enough_data && row.difference && row.blocks < kFewestBlocks)
    return "too few frames";
  if (!shows_interval(row)) return row.is_equal ? "equal" : "-";
  return fmt::format("[{}, {}]", formatted_signed(*row.low), formatted_signed(*row.high));
}

std::string enough_text(const ComparisonRow& row, const CompareConfig& config) {
  if (row.verdict != Verdict::not_enough_data || !row.difference || is_worse_in_places(row)) return "";
  // An interval of fewer blocks says too little about how movements vary to reckon with it.
  if (row.blocks < kFewestBlocks)
    return fmt::format("at least {} frames {}; {} now", kFewestBlocks * config.block_frames,
                       row.pairs < row.frames ? "with a value" : "of a movement", row.movement_frames);
  if (row.enough_frames == 0) return "";
  const double movements = std::ceil(1.0 * row.enough_frames / row.frames * row.trajectories);
  return fmt::format("{} frames of all seeds, or {:.0f} movements", row.enough_frames, movements);
}

std::string number_text(const std::optional<double>& value) { return value ? formatted(*value) : "-"; }

std::string signed_number_text(const std::optional<double>& value) {
  return value ? formatted_signed(*value) : "-";
}

std::string verdict_text(const ComparisonRow& row) {
  return is_worse_in_places(row) ? std::string(kWorseInPlaces) : std::string(to_string(row.verdict));
}

std::string row_sentence(const ComparisonRow& row) {
  return fmt::format("{} -> {} {}, difference {} {}, minimum effect {}, {} of {} frames", number_text(row.baseline),
                     number_text(row.candidate), row.metric->unit, signed_number_text(row.difference),
                     interval_text(row), number_text(row.minimum_effect), row.pairs, row.frames);
}

std::string speed_sentence(const SpeedRow& row) {
  return fmt::format("{:.2f} times faster than plain, {:.2f} at best, was {:.2f}, limit {:.2f}", row.candidate,
                     row.best, row.baseline, row.limit);
}

std::string result_sentence(const ComparedResult& result) {
  return fmt::format("{}: {}glovebench {}, commit {}", result.name,
                     result.suite.empty() ? "" : "suite " + result.suite + ", ", result.program_version,
                     result.commit);
}

std::string method_sentence(const CompareConfig& config, const std::vector<std::string>& preselected) {
  return fmt::format(
      "intervals hold together with {:g}%; metrics{}", config.confidence_percent(),
      preselected.empty() ? ": all" : fmt::format(" chosen before: {}", fmt::join(preselected, ", ")));
}

Tone tone_of(const ComparisonRow& row) {
  if (stops(row)) return Tone::worse;
  if (row.verdict == Verdict::better) return Tone::better;
  return row.verdict == Verdict::same ? Tone::same : Tone::unsure;
}

Table rows_table(std::span<const ComparisonRow> rows) {
  Table table = table_of(
      {"experiment", "quantity", "baseline", "candidate", "difference", "interval", "minimum effect", "verdict"},
      2);
  for (const ComparisonRow& row : rows)
    table.rows.push_back({readable_experiment(row.experiment), std::string(row.metric->key),
                          number_text(row.baseline), number_text(row.candidate), signed_number_text(row.difference),
                          interval_text(row), number_text(row.minimum_effect),
                          Judgment{verdict_text(row), tone_of(row)}});
  return table;
}

std::vector<Table> comparison_tables(const ComparisonReport& report) {
  std::vector<Table> tables = {enough_table(report.comparison), speed_table(report.speed),
                               configuration_table(report.comparison.configuration),
                               uncompared_table(report.comparison), times_table(report.times)};
  std::erase_if(tables, [](const Table& table) { return table.rows.empty(); });
  return tables;
}

Table verdict_first(Table table) {
  if (table.columns.back().heading != "verdict") return table;
  const auto move_last = [&](auto& cells) {
    std::rotate(cells.begin() + table.name_columns, cells.end() - 1, cells.end());
  };
  move_last(table.columns);
  for (Row& row : table.rows) move_last(row);
  ++table.name_columns;
  return table;
}

}  // namespace glovebench::reports
