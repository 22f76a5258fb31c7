#include "reports/comparison/gate_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glovebench::reports {
namespace {

/// Files round to 1e-6 of a unit, so a smaller difference decides nothing.
constexpr double kNegligible = 1e-6;
/// So many minimum effects stop a change whatever the interval says; of a share one does.
constexpr double kSurely = 2;

bool reaches(double difference, double minimum_effect) { return difference >= minimum_effect - kNegligible; }

double sure_effect(const ComparisonRow& row) { return (row.metric->is_share() ? 1 : kSurely) * row.minimum_effect; }

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : "-"; }

/// "0.52 mm [0.31, 0.73] (2.98 -> 3.50), minimum effect 0.12"
std::string numbers(const ComparisonRow& row) {
  const std::string interval =
      shows_interval(row) ? fmt::format("[{:.2f}, {:.2f}]", *row.low, *row.high) : "without an interval";
  return fmt::format("{:.2f} {} {} ({} -> {}), minimum effect {:.2f}", *row.difference, row.metric->unit, interval,
                     number(row.baseline), number(row.candidate), row.minimum_effect);
}

std::string name(const ComparisonRow& row) { return fmt::format("{}, {}", row.experiment, row.metric->key); }

std::string failure_line(const SpeedRow& row) {
  return fmt::format(
      "{}: slower: {:.2f} times as fast as the plain implementation, {:.2f} at best (it was {:.2f}), limit {:.2f}",
      row.name, row.candidate, row.best, row.baseline, row.limit);
}

}  // namespace

double least_effect(const Metric& metric, int frames) {
  constexpr double kFewestFrames = 2, kPercent = 100;
  if (!metric.is_share() || frames == 0) return metric.gate->tolerance;
  return std::max(metric.gate->tolerance, kPercent * kFewestFrames / frames);
}

double minimum_effect(const Metric& metric, std::string_view experiment, int frames, int seeds,
                      const NoiseFloor* floor) {
  const NoiseFloorEntry* entry = floor ? floor->find(experiment, metric.key) : nullptr;
  double effect = metric.gate->minimum_effect;
  if (entry) {
    // A mean over fewer seeds than the floor was measured for is noisier.
    const double fewer = static_cast<double>(floor->seeds_per_result) / std::max(1, seeds);
    effect = entry->minimum_effect * std::sqrt(std::max(1.0, fewer));
  }
  return std::max(effect, least_effect(metric, frames));
}

bool shows_interval(const ComparisonRow& row) {
  const bool is_too_wide = row.verdict == Verdict::not_enough_data && row.blocks < kFewestBlocks;
  return row.low && row.high && !is_too_wide;
}

Verdict verdict_of(const ComparisonRow& row) {
  if (row.is_equal) return Verdict::same;  // also with one block, which has no interval
  if (!row.difference || !row.low || !row.high) return Verdict::not_enough_data;
  if (*row.low > kNegligible && reaches(*row.difference, row.minimum_effect)) return Verdict::worse;
  if (*row.high < -kNegligible && reaches(-*row.difference, row.minimum_effect)) return Verdict::better;
  const double farthest = std::max(-*row.low, *row.high);
  return farthest < row.minimum_effect - kNegligible ? Verdict::same : Verdict::not_enough_data;
}

bool stops(const ComparisonRow& row) {
  if (row.verdict == Verdict::worse) return true;
  return row.difference && reaches(*row.difference, sure_effect(row));
}

bool is_worse_in_places(const ComparisonRow& row) { return stops(row) && row.verdict != Verdict::worse; }

double missing_to_stop(const ComparisonRow& row) {
  double enough = sure_effect(row);
  if (row.high) enough = std::min(enough, std::max(row.minimum_effect, *row.high - *row.difference));
  return enough - *row.difference;
}

GateDecision decide(const Comparison& comparison, const std::vector<SpeedRow>& speed) {
  GateDecision decision;
  if (!comparison.has_noise_floor)
    decision.warnings.emplace_back("no noise floor: the minimum effects are defaults, not measured");
  for (const auto& [metric, why] : comparison.uncompared_metrics)
    decision.warnings.push_back(fmt::format("{}: not compared, {}", metric, why));
  for (const ComparisonRow& row : comparison.rows) {
    const bool in_places = is_worse_in_places(row);
    decision.has_places |= in_places;
    if (stops(row))
      decision.failures.push_back(
          fmt::format("{}: {} {}", name(row), in_places ? "worse in places, up by" : "worse by", numbers(row)));
    else if (row.verdict == Verdict::not_enough_data && row.difference &&
             reaches(*row.difference, row.minimum_effect))
      decision.warnings.push_back(fmt::format("{}: not enough data to tell, up by {}", name(row), numbers(row)));
  }
  for (const SpeedRow& row : speed)
    if (row.slower) decision.failures.push_back(failure_line(row));
  return decision;
}

}  // namespace glovebench::reports
