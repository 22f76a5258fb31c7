#include "reports/comparison/noise_floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/random.h"
#include "reports/comparison/comparison_rows.h"
#include "reports/comparison/gate_rule.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr int kDraws = 100;
constexpr double kPower = 0.9;
/// Enough to know a draw's standard error to 2%, which is finer than the quantile over the draws.
constexpr int kResamples = 1000;

/// Mean per seed; empty if a seed has no value of the metric.
using SeedMeans = std::optional<std::vector<double>>;

SeedMeans seed_means(const Metric& metric, const ExperimentResult& experiment) {
  std::vector<double> means;
  for (const SeedRun& run : experiment.runs) {
    std::vector<double> values;
    for (const FrameRecord& frame : run.frames)
      if (const auto value = value_of(metric, frame)) values.push_back(*value);
    if (values.empty()) return std::nullopt;
    means.push_back(*mean(values));
  }
  return means;
}

double standard_deviation(const std::vector<double>& values) {
  const double center = *mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - center) * (value - center);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1));
}

/// Spreads of one metric, over all experiments and per experiment; empty without values.
struct Spreads {
  std::optional<double> all;
  std::vector<std::optional<double>> experiments;
  int measured = 0;  ///< experiments with a spread
};

/// An experiment's spread is at least the RMS over all experiments: few seeds estimate a spread badly, and one
/// that is too small would raise false alarms.
Spreads measure_spreads(const Metric& metric, const RunResult& result) {
  Spreads spreads;
  std::vector<double> measured, sums(result.experiments.front().runs.size());
  for (const ExperimentResult& experiment : result.experiments) {
    const SeedMeans means = seed_means(metric, experiment);
    spreads.experiments.emplace_back();
    if (!means) continue;
    measured.push_back(standard_deviation(*means));
    spreads.experiments.back() = measured.back();
    for (size_t s = 0; s < sums.size(); ++s) sums[s] += (*means)[s];
  }
  spreads.measured = static_cast<int>(measured.size());
  if (measured.empty()) return spreads;
  spreads.all = standard_deviation(sums) / spreads.measured;
  for (auto& spread : spreads.experiments)
    if (spread) spread = std::max(*spread, *rms(measured));
  return spreads;
}

/// Of a share, those that have an answer.
int frames_of(const ExperimentResult& experiment, const Metric& metric, int seeds) {
  const std::vector<FrameRecord>& frames = experiment.runs.front().frames;
  if (!metric.is_share()) return seeds * static_cast<int>(frames.size());
  return seeds * static_cast<int>(std::ranges::count_if(
                     frames, [&](const FrameRecord& frame) { return value_of(metric, frame).has_value(); }));
}

/// One entry per row of a comparison that has a spread, without `detectable`.
std::vector<NoiseFloorEntry> measure_effects(const RunResult& result, const NoiseFloor& floor) {
  const std::vector<const Metric*> metrics = shared_metrics(result.protocol, result.protocol);
  const double tail_error = floor.family_error / (2 * row_count(metrics.size(), result.experiments.size()));
  const double difference_of_means = std::sqrt(2.0 / floor.seeds_per_result);
  std::vector<NoiseFloorEntry> entries;
  for (const Metric* metric : metrics) {
    const Spreads spreads = measure_spreads(*metric, result);
    const auto add = [&](std::string experiment, double spread, int degrees_of_freedom, int frames) {
      const double effect = student_t_above(tail_error, degrees_of_freedom) * spread * difference_of_means;
      entries.push_back({std::move(experiment), std::string(metric->key), spread,
                         std::max(effect, least_effect(*metric, frames)), 0});
    };
    int all_frames = 0;
    for (size_t e = 0; e < result.experiments.size(); ++e) {
      const ExperimentResult& experiment = result.experiments[e];
      if (!spreads.experiments[e]) continue;
      const int frames = frames_of(experiment, *metric, floor.seeds_per_result);
      all_frames += frames;
      add(to_string(experiment.key), *spreads.experiments[e], spreads.measured * (floor.seeds - 1), frames);
    }
    if (spreads.all)
      add(std::string(kAllExperiments), *spreads.all, floor.seeds - 1, all_frames / spreads.measured);
  }
  return entries;
}

/// Draws two results of disjoint seeds from one with many.
std::pair<RunResult, RunResult> draw_results(const RunResult& result, int seeds, int draw) {
  std::vector<size_t> order(result.experiments.front().runs.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  RandomStream random(1, "noise floor", draw, "seeds");
  for (int i = 0; i < 2 * seeds; ++i) std::swap(order[i], order[i + random.index(order.size() - i)]);
  std::pair<RunResult, RunResult> drawn;
  for (const ExperimentResult& experiment : result.experiments) {
    ExperimentResult &first = drawn.first.experiments.emplace_back(),
                     &second = drawn.second.experiments.emplace_back();
    first.key = second.key = experiment.key;
    for (int i = 0; i < seeds; ++i) {
      first.runs.push_back(experiment.runs[order[i]]);
      second.runs.push_back(experiment.runs[order[seeds + i]]);
    }
  }
  return drawn;
}

/// Keeps the entries for which comparisons have a difference, and adds the change that they detect.
std::vector<NoiseFloorEntry> with_detectable(const RunResult& result, const NoiseFloor& floor) {
  const CompareConfig config = {.family_error = floor.family_error, .resamples = kResamples};
  Draws draws(config.seed, config.resamples);
  std::map<std::pair<std::string, std::string>, std::vector<double>> needed;
  for (int d = 0; d < kDraws; ++d) {
    const auto [baseline, candidate] = draw_results(result, floor.seeds_per_result, d);
    Pairing pairing;
    pairing.metrics = shared_metrics(result.protocol, result.protocol);
    for (size_t e = 0; e < baseline.experiments.size(); ++e)
      pairing.experiments.emplace_back(&baseline.experiments[e], &candidate.experiments[e]);
    for (const ComparisonRow& row : comparison_rows(pairing, &floor, config, draws))
      if (row.difference) needed[{row.experiment, std::string(row.metric->key)}].push_back(missing_to_stop(row));
  }
  std::vector<NoiseFloorEntry> entries;
  for (NoiseFloorEntry entry : floor.entries) {
    const std::vector<double>& changes = needed[{entry.experiment, entry.quantity}];
    if (changes.size() < kDraws) continue;
    entry.detectable = std::max(0.0, *percentile(changes, kPower));
    entries.push_back(std::move(entry));
  }
  return entries;
}

void check_seeds(const RunResult& result, int seeds_per_result) {
  constexpr const char* kWhere = "noise floor";
  const int fewest = kSeedsForEach * seeds_per_result;
  if (result.experiments.empty()) throw Error(kWhere, "experiments", "none", "at least one");
  const std::vector<SeedRun>& first = result.experiments.front().runs;
  for (const ExperimentResult& experiment : result.experiments) {
    const auto seeds = static_cast<int>(experiment.runs.size());
    const std::string field = to_string(experiment.key) + ".seeds";
    if (seeds < fewest) throw Error(kWhere, field, std::to_string(seeds), fmt::format("at least {}", fewest));
    if (!std::ranges::equal(experiment.runs, first, {}, &SeedRun::seed, &SeedRun::seed))
      throw Error(kWhere, field, "other seeds", "those of the first experiment");
  }
}

constexpr std::string_view kNoiseFloorFormat = "glovebench-noise-floor";
constexpr int kVersion = 1;

/// In millimeters, degrees or percent: larger values are damage, smaller ones are written as 0.
constexpr double kLargestAmount = 1e6, kSmallestAmount = 1e-6;

NoiseFloorEntry read_entry(const JsonCursor& json) {
  json.expect_keys({"experiment", "quantity", "spread", "minimum_effect", "detectable"});
  return {json["experiment"].text(), json["quantity"].name(), json["spread"].number(0, kLargestAmount),
          json["minimum_effect"].number(kSmallestAmount, kLargestAmount),
          json["detectable"].number(0, kLargestAmount)};
}

std::vector<NoiseFloorEntry> read_entries(const JsonCursor& json) {
  std::vector<NoiseFloorEntry> entries;
  std::set<std::pair<std::string, std::string>> known;
  for (const JsonCursor& item : json.items()) {
    entries.push_back(read_entry(item));
    if (!known.emplace(entries.back().experiment, entries.back().quantity).second)
      item.fail("an experiment and quantity that is not above");
  }
  return entries;
}

}  // namespace

const NoiseFloorEntry* NoiseFloor::find(std::string_view experiment, std::string_view quantity) const {
  const auto found = std::ranges::find_if(entries, [&](const NoiseFloorEntry& entry) {
    return entry.experiment == experiment && entry.quantity == quantity;
  });
  return found == entries.end() ? nullptr : &*found;
}

NoiseFloor measure_noise_floor(const RunResult& result, int seeds_per_result, double family_error) {
  check(seeds_per_result >= 1 && family_error > 0 && family_error <= kLargestFamilyError,
        "a noise floor has seeds and an error");
  check_seeds(result, seeds_per_result);
  NoiseFloor floor;
  floor.suite = result.suite;
  floor.seeds = static_cast<int>(result.experiments.front().runs.size());
  floor.seeds_per_result = seeds_per_result;
  floor.family_error = family_error;
  floor.commit = result.commit;
  floor.entries = measure_effects(result, floor);
  floor.entries = with_detectable(result, floor);
  return floor;
}

std::string noise_floor_json(const NoiseFloor& floor) {
  nlohmann::ordered_json json = {{"format", kNoiseFloorFormat},
                                 {"version", kVersion},
                                 {"suite", floor.suite},
                                 {"seeds", floor.seeds},
                                 {"seeds_per_result", floor.seeds_per_result},
                                 {"family_error", floor.family_error},
                                 {"commit", floor.commit},
                                 {"date", floor.date},
                                 {"entries", nlohmann::ordered_json::array()}};
  for (const NoiseFloorEntry& entry : floor.entries)
    json["entries"].push_back({{"experiment", entry.experiment},
                               {"quantity", entry.quantity},
                               {"spread", rounded(entry.spread)},
                               {"minimum_effect", rounded(entry.minimum_effect)},
                               {"detectable", rounded(entry.detectable)}});
  return format_json(json);
}

NoiseFloor read_noise_floor(const std::string& path) {
  return parse_noise_floor(read_file(path, kLargestSmallFile), path);
}

NoiseFloor parse_noise_floor(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format(kNoiseFloorFormat, kVersion);
  json.expect_keys(
      {"format", "version", "suite", "seeds", "seeds_per_result", "family_error", "commit", "date", "entries"});
  NoiseFloor floor;
  floor.suite = json["suite"].text();
  floor.seeds = static_cast<int>(json["seeds"].integer(kSeedsForEach, std::numeric_limits<int>::max()));
  floor.seeds_per_result = static_cast<int>(json["seeds_per_result"].integer(1, floor.seeds / kSeedsForEach));
  floor.family_error = json["family_error"].number(kSmallestAmount, kLargestFamilyError);
  floor.commit = json["commit"].text();
  floor.date = json["date"].text();
  floor.entries = read_entries(json["entries"]);
  return floor;
}

}  // namespace glovebench::reports
