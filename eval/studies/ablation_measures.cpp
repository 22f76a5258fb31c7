#include <algorithm>

#include "eval/studies/ablations.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Measure;

constexpr const char* kLatencyDatabase = "DB_open_pinch_power";
const std::vector<std::string> kColorDatabases = {"DB_open_pinch_power", "DB_20_postures"};
constexpr const char* kColorBlind = "color-blind";

/// Latency of each movement, averaged over seeds that have one.
std::vector<std::optional<double>> latencies(const Selection& runs) {
  std::vector<std::optional<double>> result;
  for (const auto& stratum : sequences_of(runs))
    result.push_back(reports::mean_present(stratum, &reports::SequenceMetrics::latency_frames));
  return result;
}

std::optional<double> mean_of(const std::vector<std::optional<double>>& values, std::span<const int> drawn) {
  return reports::mean_present(drawn, [&](int i) { return values[i]; });
}

/// 1 in frames with a wrong look-up, else 0.
Sample wrong_look_ups(const Selection& runs) {
  return sample_of(runs, [](const MeasuredRun& run, size_t frame) -> std::optional<double> {
    const std::optional<double>& posture = run.errors[frame].record["posture_rms_unfiltered_deg"];
    return posture && *posture > kWrongLookUp_deg ? 1.0 : 0.0;
  });
}

/// Per frame: `counted` is 1 if both alignments answer a wrong look-up, and `difference` is that of their errors;
/// else both are 0. Databases are combined by sums.
struct Excess {
  Sample counted;
  Sample difference;
};
Excess excess_of(const Runs& runs, const std::string& database, std::string_view metric) {
  const Selection sensitive = select(runs, kDefaultSetting, database);
  const Sample a = sample_of(select(runs, kColorBlind, database), metric), b = sample_of(sensitive, metric);
  Excess excess{wrong_look_ups(sensitive), a};
  for (size_t s = 0; s < a.size(); ++s) {
    for (size_t seed = 0; seed < a[s].size(); ++seed) {
      for (size_t f = 0; f < a[s][seed].size(); ++f) {
        std::optional<double>& counted = excess.counted[s][seed][f];
        if (!a[s][seed][f] || !b[s][seed][f]) counted = 0;
        excess.difference[s][seed][f] = *counted != 0 ? *a[s][seed][f] - *b[s][seed][f] : 0;
      }
    }
  }
  return excess;
}

Measure color_measure(const Runs& runs, const std::string& name, const std::string& unit, std::string_view metric) {
  std::vector<Sample> samples;
  for (const std::string& database : kColorDatabases) {
    Excess excess = excess_of(runs, database, metric);
    samples.push_back(std::move(excess.difference));
    samples.push_back(std::move(excess.counted));
  }
  const Estimated excess = estimate(samples, [](std::span<const double> means) -> std::optional<double> {
    double difference = 0, counted = 0;
    for (size_t i = 0; i < means.size(); i += 2) {
      difference += means[i];
      counted += means[i + 1];
    }
    if (counted == 0) return std::nullopt;
    return difference / counted;
  });
  return {name, unit, excess.value, excess.interval};
}

/// 1 in frames whose matches differ in posture, else 0.
Sample distinct_matches(const Selection& runs) {
  return sample_of(runs, [](const MeasuredRun& each, size_t frame) -> std::optional<double> {
    const TrackResult& result = each.run.answers[frame];
    if (result.status != TrackStatus::tracked) return std::nullopt;
    const auto posture = [](const Match& match) { return match.entry / kViewCount; };
    const auto differs = [&](const Match& match) { return posture(match) != posture(result.matches.front()); };
    return std::ranges::any_of(result.matches, differs) ? 1.0 : 0.0;
  });
}

}  // namespace

std::vector<Measure> lag_measures(const Runs& runs) {
  const auto with = latencies(select(runs, kDefaultSetting, kLatencyDatabase));
  const auto without = latencies(select(runs, "no filter", kLatencyDatabase));
  const auto share = [&](std::span<const int> drawn) -> std::optional<double> {
    const auto all = mean_of(with, drawn), rest = mean_of(without, drawn);
    if (!all || !rest || *all <= 0) return std::nullopt;
    return 1 - *rest / *all;
  };
  const auto mean_with = [&](std::span<const int> drawn) { return mean_of(with, drawn); };
  const auto mean_without = [&](std::span<const int> drawn) { return mean_of(without, drawn); };
  const auto over_movements = [&](const char* name, const char* unit, const auto& statistic) {
    return measure_over(static_cast<int>(with.size()), "movements", name, unit, statistic);
  };
  return {over_movements("lag.frames", "frames", mean_with),
          over_movements("lag.without_filter_frames", "frames", mean_without),
          over_movements("lag.filter_share", "", share)};
}

std::vector<Measure> color_measures(const Runs& runs) {
  return {color_measure(runs, "color.blind_excess_position_mm", "mm", "position_error_mm"),
          color_measure(runs, "color.blind_excess_rotation_deg", "deg", "rotation_error_deg")};
}

reports::Table color_table(const Runs& runs) {
  reports::Table table = {
      "color_blind",
      "Alignment with and without colors where the look-up is wrong",
      "Frames in which the posture of the look-up is wrong by more than 15 degrees RMS, of the five movements "
      "themselves, and the mean errors there of both alignments, which start from the same look-up.",
      {{"database", "database"},
       {"frames", "frames", 0},
       {"position_error_mm", "position mm"},
       {"position_error_blind_mm", "color-blind mm"},
       {"rotation_error_deg", "rotation deg"},
       {"rotation_error_blind_deg", "color-blind deg"}},
      1,
      {}};
  for (const std::string& database : kColorDatabases) {
    const Selection sensitive = select(runs, kDefaultSetting, database),
                    blind = select(runs, kColorBlind, database);
    const Sample wrong = wrong_look_ups(sensitive);
    int64_t frames = 0;
    for (const auto& stratum : wrong)
      for (const auto& seed : stratum) frames += std::ranges::count(seed, std::optional(1.0));
    std::vector<Cell> row = {database, frames};
    for (const char* metric : {"position_error_mm", "rotation_error_deg"})
      for (const Selection* selected : {&sensitive, &blind})
        row.push_back(cell(mean(where(sample_of(*selected, metric), wrong))));
    table.rows.push_back(row);
  }
  return table;
}

Measure interpolation_measure(const Runs& runs) {
  const Selection three = select(runs, kDefaultSetting, "DB_open_power");
  const char* metric = "posture_rms_unfiltered_deg";
  const Sample one = sample_of(select(runs, "1 neighbor", "DB_open_power"), metric);
  const Estimated excess = estimate_difference(where(sample_of(three, metric), distinct_matches(three)), one);
  return {"interpolation.distinct_excess_deg", "deg", excess.value, excess.interval};
}

std::vector<Ablation> measured_ablations() {
  Ablation color{"color", {}};
  for (const std::string& database : kColorDatabases)
    for (const char* setting : {kDefaultSetting, kColorBlind}) color.rows.push_back({"", setting, database});
  return {color};
}

}  // namespace glovebench::eval
