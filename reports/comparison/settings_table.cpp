#include "reports/comparison/settings_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/tracker/tracker_config.h"
#include "reports/comparison/comparison_text.h"
#include "reports/comparison/gate_rule.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

/// A time that is less by a smaller share is not worth a word.
constexpr double kTimeShare = 0.1;
constexpr const char* kTimeKey = "time_ms";

/// A run beside the reference. Rows are those over all experiments, in the order of the metrics.
struct Compared {
  const SettingRun* setting;
  std::optional<Comparison> comparison;  ///< empty: the reference itself
  std::vector<ComparisonRow> rows;

  const std::string& name() const { return setting->run.name; }
  bool has(Verdict verdict) const { return std::ranges::count(rows, verdict, &ComparisonRow::verdict) > 0; }
  bool is_worse() const { return std::ranges::any_of(rows, stops); }
};

/// A field that an older run lacks has the paper's value. A run with a person's hand is not the paper's.
bool has_paper_configuration(const SettingRun& setting) {
  const nlohmann::json& configuration = setting.run.result.configuration;
  if (configuration.contains("hand")) return false;
  const TrackerConfig paper = glovebench::profile("paper");
  try {
    const TrackerConfig own = config_from_json(configuration.at("tracker"), paper, setting.run.name);
    return glovebench::to_json(own) == glovebench::to_json(paper);
  } catch (const std::exception&) {  // of another version
    return false;
  }
}

void require_several(const std::vector<SettingRun>& runs) {
  if (runs.size() < 2) throw Error("table", "runs", fmt::format("{}", runs.size()), "two or more");
  std::set<std::string> names;
  for (const SettingRun& each : runs)
    if (!names.insert(each.run.name).second)
      throw Error("table", "runs", each.run.name + " twice", "runs of different names");
}

/// The experiments that some of the runs lack (`table --partial`).
std::set<std::string> unshared(const std::vector<Compared>& all) {
  std::set<std::string> names;
  for (const Compared& each : all) {
    if (!each.comparison) continue;
    names.insert(each.comparison->only_in_baseline.begin(), each.comparison->only_in_baseline.end());
    names.insert(each.comparison->only_in_candidate.begin(), each.comparison->only_in_candidate.end());
  }
  return names;
}

/// Of all frames of an experiment that have a value, then over the experiments but `left_out`.
std::optional<double> mean_of(const RunResult& result, const Metric& metric,
                              const std::set<std::string>& left_out) {
  std::vector<double> means;
  for (const ExperimentResult& experiment : result.experiments) {
    if (left_out.contains(to_string(experiment.key))) continue;
    std::vector<double> values;
    for (const SeedRun& run : experiment.runs)
      for (const FrameRecord& frame : run.frames)
        if (const auto value = value_of(metric, frame)) values.push_back(*value);
    if (const auto value = mean(values)) means.push_back(*value);
  }
  return mean(means);
}

std::vector<Compared> compared_with(const std::vector<SettingRun>& runs, const SettingRun& reference,
                                    const PairingOptions& pairing, CompareConfig config) {
  config.family_error /= static_cast<double>(runs.size() - 1);
  std::vector<Compared> all;
  for (const SettingRun& each : runs) {
    Compared& compared = all.emplace_back(Compared{&each, std::nullopt, {}});
    if (&each == &reference) continue;
    compared.comparison = compare_results(reference.run, each.run, nullptr, pairing, config);
    std::ranges::copy_if(compared.comparison->rows, std::back_inserter(compared.rows),
                         [](const ComparisonRow& row) { return row.experiment == kAllExperiments; });
  }
  return all;
}

using Cells = std::map<std::string, Cell>;  // by the column's key

/// Columns without a cell stay empty.
void add_setting_row(Table& table, const std::string& quantity, const Compared& compared, Cells cells) {
  cells.insert({{"quantity", quantity}, {"setting", compared.name()}, {"verdict", Judgment{"", Tone::same}}});
  Row& row = table.rows.emplace_back(table.columns.size());
  for (const auto& [key, value] : cells) row[column_index(table, key)] = value;
}

Cells error_cells(const Compared& compared, const Metric* metric, const std::set<std::string>& left_out) {
  Cells cells = {{"mean", cell(mean_of(compared.setting->run.result, *metric, left_out))}};
  const auto row = std::ranges::find(compared.rows, metric, &ComparisonRow::metric);
  if (row == compared.rows.end()) return cells;  // the reference, or an older run, which lacks the metric
  cells["difference"] = cell(row->difference);
  if (shows_interval(*row)) cells.insert({{"low", cell(row->low)}, {"high", cell(row->high)}});
  cells["verdict"] = Judgment{verdict_text(*row), tone_of(*row)};
  return cells;
}

Cells time_cells(const Compared& compared, const Compared& reference) {
  const std::optional<double> ms = compared.setting->time_ms, reference_ms = reference.setting->time_ms;
  Cells cells = {{"mean", cell(ms)}};
  if (&compared != &reference && ms && reference_ms) cells["difference"] = *ms - *reference_ms;
  return cells;
}

Table table_of_all(const std::vector<Compared>& all, const Compared& reference,
                   const std::vector<const Metric*>& metrics, bool has_times) {
  constexpr int kDigits = 3, kNames = 2;
  Table table = {"settings",
                 "Settings",
                 "",
                 {{"quantity", "quantity"},
                  {"setting", "setting"},
                  {"mean", "mean", kDigits},
                  {"difference", "difference", kDigits},
                  {"low", "low", kDigits},
                  {"high", "high", kDigits},
                  {"verdict", "verdict"}},
                 kNames,
                 {}};
  const std::set<std::string> left_out = unshared(all);
  for (const Metric* metric : metrics)
    for (const Compared& each : all)
      add_setting_row(table, std::string(metric->key), each, error_cells(each, metric, left_out));
  for (const Compared& each : all)
    if (has_times) add_setting_row(table, kTimeKey, each, time_cells(each, reference));
  return table;
}

Table changes_of(const std::vector<Compared>& all) {
  Table table = table_of({"setting", "field", "reference", "here"}, 4);
  for (const Compared& each : all)
    if (each.comparison)
      for (const ConfigurationChange& change : each.comparison->configuration)
        table.rows.push_back({each.name(), change.field, change.baseline.empty() ? "-" : change.baseline,
                              change.candidate.empty() ? "-" : change.candidate});
  return table;
}

std::vector<std::string> enough_lines(const std::vector<Compared>& all) {
  std::vector<std::string> lines;
  for (const Compared& each : all)
    for (const ComparisonRow& row : each.rows)
      if (const std::string enough = enough_text(row, each.comparison->config); !enough.empty())
        lines.push_back(fmt::format("{}, {}: {}", each.name(), row.metric->key, enough));
  return lines;
}

/// "position_error_mm (-0.310), uncovered_percent (-2.100)"
std::string quantities_with(const Compared& compared, Verdict verdict) {
  std::vector<std::string> texts;
  for (const ComparisonRow& row : compared.rows)
    if (row.verdict == verdict)
      texts.push_back(fmt::format("{} ({})", row.metric->key, signed_number_text(row.difference)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The gains in minimum effects, so that quantities of different units add up.
double gain_of(const Compared& compared) {
  double gain = 0;
  for (const ComparisonRow& row : compared.rows)
    if (row.verdict == Verdict::better) gain -= *row.difference / row.minimum_effect;
  return gain;
}

/// The share of time that a setting saved. Null unless both times are known and differ enough; also for equal
/// configurations, whose times differ by chance.
std::optional<double> speed_gain(const Compared& compared, const Compared& reference) {
  const auto mine = compared.setting->time_ms, its = reference.setting->time_ms;
  const bool differs = compared.comparison && !compared.comparison->configuration.empty();
  if (!differs || !mine || !its || *mine >= (1 - kTimeShare) * *its) return std::nullopt;
  return 1 - *mine / *its;
}

/// Better in a quantity and worse in none; among several the one that gains most.
const Compared* best_of(const std::vector<Compared>& all) {
  const Compared* best = nullptr;
  for (const Compared& each : all)
    if (each.has(Verdict::better) && !each.is_worse() && (!best || gain_of(each) > gain_of(*best))) best = &each;
  return best;
}

bool is_undecided(const Compared& compared) {
  return compared.has(Verdict::not_enough_data) && !compared.is_worse();
}

/// What would decide every quantity of a setting: the most that one of them needs. Empty: unknown.
std::string need_of(const Compared& compared) {
  std::string most;
  int frames = 0;
  for (const ComparisonRow& row : compared.rows) {
    const std::string enough = enough_text(row, compared.comparison->config);
    if (enough.empty()) continue;
    const int needed = row.blocks < kFewestBlocks ? std::numeric_limits<int>::max() : row.enough_frames;
    if (needed <= frames) continue;
    frames = needed;
    most = enough;
  }
  return most;
}

/// What speaks for a setting that is not recommended.
std::string case_for(const Compared& each, const Compared& reference) {
  std::string text;
  if (each.has(Verdict::better) && each.is_worse())
    text += fmt::format(" {} is better in {}, but worse in other quantities: a choice.", each.name(),
                        quantities_with(each, Verdict::better));
  if (is_undecided(each)) {
    text += fmt::format(" {} is undecided in {}", each.name(), quantities_with(each, Verdict::not_enough_data));
    const std::string need = need_of(each);
    text += need.empty() ? "." : fmt::format(". It needs {}.", need);
  }
  const std::optional<double> gain = speed_gain(each, reference);
  if (gain && !each.is_worse())
    text += fmt::format(" {} took {:.0f}% less time, measured once: repeat that before you choose by time.",
                        each.name(), 100 * *gain);
  return text;
}

std::string basis_of(const SettingRun& reference, size_t metrics, const std::set<std::string>& left_out) {
  std::set<std::string> movements;
  size_t frames = 0, seeds = 0;
  for (const ExperimentResult& experiment : reference.run.result.experiments) {
    if (left_out.contains(to_string(experiment.key))) continue;
    movements.insert(experiment.key.trajectory);
    frames += static_cast<size_t>(experiment.coverage.frames);
    seeds = std::max(seeds, experiment.runs.size());
  }
  return fmt::format(
      " This rests on {} frames of {} with {}, in {}; it says nothing about other movements or hands, and the "
      "settings were compared with the reference, not with each other.",
      frames, counted(movements.size(), "movement"), counted(seeds, "noise seed"), counted(metrics, "metric"));
}

/// By name; many by their number.
std::string experiments_of(const SettingRun& reference, const std::set<std::string>& left_out) {
  constexpr size_t kMostNamed = 3;
  std::vector<std::string> names;
  for (const ExperimentResult& experiment : reference.run.result.experiments)
    if (const std::string name = to_string(experiment.key); !left_out.contains(name)) names.push_back(name);
  return names.size() <= kMostNamed ? fmt::format("{}", fmt::join(names, " "))
                                    : fmt::format("{} experiments", names.size());
}

std::string recommendation_of(const std::vector<Compared>& all, const Compared& reference, size_t metrics) {
  const Compared* best = best_of(all);
  std::string text;
  if (best) {
    text = fmt::format("Recommended: {}. It is better than {} in {} and worse in none.", best->name(),
                       reference.name(), quantities_with(*best, Verdict::better));
    if (best->has(Verdict::not_enough_data))
      text += fmt::format(" Undecided: {}.", quantities_with(*best, Verdict::not_enough_data));
  } else if (std::ranges::any_of(all, is_undecided)) {
    text = "No recommendation: not enough data.";
  } else {
    text = fmt::format("Recommended: {}. No other setting is better in one quantity and worse in none.",
                       reference.name());
  }
  for (const Compared& each : all)
    if (&each != best) text += case_for(each, reference);
  return text + basis_of(*reference.setting, metrics, unshared(all));
}

std::string explanation_of(const SettingsTable& settings) {
  return fmt::format(
      "Means are over the frames that have a value, then over the experiments that all runs have. Differences are "
      "from {}{}, frame by frame over the frames that both have; above zero is worse. The intervals low to high "
      "are paired (bootstrap over noise seeds and blocks of at least {} frames) and hold together with {:g}%. "
      "Verdicts as in `glovebench compare`. {}",
      settings.reference, settings.is_paper ? ", the paper's settings" : ", the first run",
      settings.config.block_frames, settings.config.confidence_percent(),
      settings.has_times
          ? "time_ms: medians of the stages of a frame, added up, processor time of one thread while no other "
            "job of the command ran. Times have no verdict: they were measured once, and those of equal "
            "settings differ, too."
          : "No times: none of these runs was timed alone (several settings in one `glovebench run`, or "
            "--threads 1).");
}

}  // namespace

std::vector<std::string> headline_metrics() {
  return {"position_error_mm", "posture_rms_deg", "rotation_error_deg", "fingertip_error_mm", "uncovered_percent"};
}

SettingsTable compare_settings(const std::vector<SettingRun>& runs, const PairingOptions& pairing,
                               const CompareConfig& config) {
  require_several(runs);
  auto reference = std::ranges::find_if(runs, has_paper_configuration);
  SettingsTable settings;
  settings.is_paper = reference != runs.end();
  if (!settings.is_paper) reference = runs.begin();
  settings.reference = reference->run.name;
  const std::vector<Compared> all = compared_with(runs, *reference, pairing, config);
  std::vector<const Metric*> metrics;
  for (const Compared& each : all)
    for (const ComparisonRow& row : each.rows)
      if (std::ranges::count(metrics, row.metric) == 0) metrics.push_back(row.metric);
  const Compared& first = all[static_cast<size_t>(reference - runs.begin())];
  settings.config = config;
  settings.preselected = pairing.metrics;
  settings.experiments = experiments_of(*reference, unshared(all));
  for (const SettingRun& each : runs) settings.runs[each.run.name] = run_name(each.run.result);
  settings.has_times = std::ranges::any_of(runs, [](const SettingRun& each) { return each.time_ms.has_value(); });
  settings.table = table_of_all(all, first, metrics, settings.has_times);
  settings.changes = changes_of(all);
  settings.enough = enough_lines(all);
  settings.recommendation = recommendation_of(all, first, metrics.size());
  settings.explanation = explanation_of(settings);
  return settings;
}

}  // namespace glovebench::reports
