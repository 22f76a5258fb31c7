#include "reports/comparison/gate.h"

#include <fmt/format.h>

#include "reports/comparison/comparison_rows.h"

namespace glovebench::reports {
namespace {

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "-";
}

/// "0.52 mm [0.31, 0.73] (2.98 -> 3.50), minimum effect 0.12"
std::string numbers(const ComparisonRow& row) {
  const std::string interval =
      row.low && row.high ? fmt::format("[{:.2f}, {:.2f}]", *row.low, *row.high) : "without an interval";
  return fmt::format("{:.2f} {} {} ({} -> {}), minimum effect {:.2f}", *row.difference, row.metric->unit, interval,
                     number(row.baseline), number(row.candidate), row.minimum_effect);
}

std::string name(const ComparisonRow& row) {
  return fmt::format("{}, {}", row.experiment, row.metric->key);
}

/// A change that the interval cannot tell from chance sits in a few stretches: the page shows where.
std::string how(const ComparisonRow& row) {
  return row.verdict == Verdict::worse ? "worse by" : "worse in places, up by";
}

std::string failure_line(const SpeedRow& row) {
  return fmt::format(
      "{}: slower: {:.2f} times as fast as the plain implementation, {:.2f} at best (it was {:.2f}), limit {:.2f}",
      row.name, row.candidate, row.best, row.baseline, row.limit);
}

}  // namespace

double sure_effect(const ComparisonRow& row) {
  return (row.metric->is_share() ? 1 : kSurely) * row.minimum_effect;
}

bool stops(const ComparisonRow& row) {
  if (row.verdict == Verdict::worse) return true;
  return row.difference && reaches(*row.difference, sure_effect(row));
}

GateDecision decide(const Comparison& comparison, const std::vector<SpeedRow>& speed) {
  GateDecision decision;
  if (!comparison.has_noise_floor)
    decision.warnings.emplace_back("no noise floor: the minimum effects are defaults, not measured");
  for (const auto& [metric, why] : comparison.uncompared_metrics)
    decision.warnings.push_back(fmt::format("{}: not compared, {}", metric, why));
  for (const ComparisonRow& row : comparison.rows) {
    if (stops(row))
      decision.failures.push_back(fmt::format("{}: {} {}", name(row), how(row), numbers(row)));
    else if (row.verdict == Verdict::not_enough_data && row.difference &&
             reaches(*row.difference, row.minimum_effect))
      decision.warnings.push_back(fmt::format("{}: not enough data to tell, up by {}", name(row), numbers(row)));
  }
  for (const SpeedRow& row : speed)
    if (row.slower) decision.failures.push_back(failure_line(row));
  return decision;
}

}  // namespace glovebench::reports
