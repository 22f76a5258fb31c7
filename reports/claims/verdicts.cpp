#include "reports/claims/verdicts.h"

#include <algorithm>
#include <cmath>

#include "core/tracker/tracker_config.h"
#include "reports/claims/figure4_measures.h"

namespace glovebench::reports {
namespace {

constexpr double kLevel = 0.95;

bool is_interval(const ConfidenceInterval& interval) {
  return std::isfinite(interval.low) && std::isfinite(interval.high) && interval.low <= interval.high;
}

/// 1 if the claim holds, -1 if it does not, 0 if that is unknown.
int sign_of(const Rule& rule, const Measure& measure) {
  if (!measure.value || !std::isfinite(*measure.value)) return 0;
  if (!holds(rule, *measure.value)) return -1;
  if (!measure.interval) return 1;
  const double low = measure.interval->low, high = measure.interval->high;
  if (!is_interval(*measure.interval)) return 0;
  if (!meets(rule, low, high)) return -1;
  // A rule is an interval, so it holds between two values if it holds for both.
  return holds(rule, low) && holds(rule, high) ? 1 : 0;
}

ClaimOutcome outcome_of(const ClaimDefinition& claim, const Measure& measure) {
  const bool is_consistency = claim.kind == ClaimKind::consistency;
  const int sign = sign_of(claim.rule, measure);
  if (sign > 0) return is_consistency ? ClaimOutcome::consistent : ClaimOutcome::reproduced;
  if (sign < 0) return is_consistency ? ClaimOutcome::not_consistent : ClaimOutcome::not_reproduced;
  return ClaimOutcome::inconclusive;
}

ClaimVerdict verdict_of(const Claim& claim, Measure measure) {
  const ClaimOutcome outcome =
      claim.definition().withdrawn ? ClaimOutcome::withdrawn : outcome_of(claim.definition(), measure);
  if (measure.value && !std::isfinite(*measure.value)) measure.value.reset();
  if (measure.interval && !is_interval(*measure.interval)) measure.interval.reset();
  return {claim, std::move(measure), outcome};
}

bool does_hold(ClaimOutcome outcome) {
  return outcome == ClaimOutcome::reproduced || outcome == ClaimOutcome::consistent;
}

/// Makes required claims inconclusive that do not hold at 5% together (Holm).
std::vector<ClaimVerdict> judged_together(std::vector<ClaimVerdict> verdicts) {
  std::vector<size_t> required;
  std::vector<double> p_values;
  for (size_t v = 0; v < verdicts.size(); ++v) {
    const auto& [claim, measure, outcome, p] = verdicts[v];
    if (!claim.definition().required || outcome == ClaimOutcome::withdrawn) continue;
    required.push_back(v);
    const bool has_interval = measure && measure->value && measure->interval;
    p_values.push_back(has_interval ? p_value(claim.definition().rule, *measure->value, *measure->interval) : 1);
  }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (size_t i = 0; i < required.size(); ++i) {
    ClaimVerdict& verdict = verdicts[required[i]];
    if (!verdict.measure || !verdict.measure->value || !verdict.measure->interval) continue;
    verdict.p = adjusted[i];
    if (does_hold(verdict.outcome) && adjusted[i] > 1 - kLevel) verdict.outcome = ClaimOutcome::inconclusive;
  }
  return verdicts;
}

/// Claims are about the paper's configuration, not about other programs' estimates. A run without a configuration
/// counts as the paper's.
bool is_of_the_paper(const nlohmann::json& configuration) {
  const auto tracker = configuration.find("tracker");
  return !configuration.contains("score") &&
         (tracker == configuration.end() || *tracker == to_json(profile("paper")));
}

}  // namespace

bool are_claims_judged(const RunResult& result) {
  return !result.configuration.value("quick", false) && is_of_the_paper(result.configuration);
}

std::vector<Measure> all_measures(const RunResult& result) {
  if (!are_claims_judged(result)) return {};
  std::vector<Measure> measures = figure4_measures(result);
  for (const StudyResult& study : result.studies)
    measures.insert(measures.end(), study.measures.begin(), study.measures.end());
  return measures;
}

double p_value(const Rule& rule, double value, const ConfidenceInterval& interval) {
  constexpr int kDegreesOfFreedom = 4;
  if (!holds(rule, value)) return 1;
  const double half = (interval.high - interval.low) / 2, t = student_quantile(kLevel, kDegreesOfFreedom);
  const auto on_side = [&](double margin, double arm) {
    const double scale = std::max(arm, half);
    return scale == 0 ? 0 : student_p(t * margin / scale, kDegreesOfFreedom);
  };
  return std::max(on_side(value - rule.low, value - interval.low),
                  on_side(rule.high - value, interval.high - value));
}

std::vector<ClaimVerdict> judge(const std::vector<Claim>& claims, const std::vector<Measure>& measures) {
  std::vector<ClaimVerdict> verdicts;
  for (const Claim& claim : claims) {
    const auto measure = std::ranges::find(measures, claim.definition().measure, &Measure::name);
    if (measure != measures.end())
      verdicts.push_back(verdict_of(claim, *measure));
    else
      verdicts.push_back(
          {claim, {}, claim.definition().withdrawn ? ClaimOutcome::withdrawn : ClaimOutcome::not_run});
  }
  return judged_together(std::move(verdicts));
}

RequiredClaims count_required(const std::vector<ClaimVerdict>& verdicts) {
  RequiredClaims count;
  for (const auto& [claim, measure, outcome, p] : verdicts) {
    if (!claim.definition().required || outcome == ClaimOutcome::withdrawn) continue;
    if (outcome == ClaimOutcome::not_run)
      ++count.not_run;
    else if (does_hold(outcome))
      ++count.hold;
    else if (outcome == ClaimOutcome::inconclusive && measure && measure->value && measure->interval)
      ++count.inconclusive;
    else
      ++count.failed;
  }
  return count;
}

bool any_was_run(const std::vector<ClaimVerdict>& verdicts) {
  return std::ranges::any_of(verdicts, [](const ClaimVerdict& v) {
    return v.outcome != ClaimOutcome::not_run && v.outcome != ClaimOutcome::withdrawn;
  });
}

}  // namespace glovebench::reports
