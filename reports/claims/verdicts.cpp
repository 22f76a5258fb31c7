#include "reports/claims/verdicts.h"

#include <algorithm>

#include "core/tracker/tracker_config.h"
#include "reports/claims/figure4_measures.h"

namespace glovebench::reports {
namespace {

ClaimOutcome judge(const Claim& claim, const Measure& measure) {
  if (!measure.value && !measure.interval) return ClaimOutcome::inconclusive;
  const double low = measure.interval ? measure.interval->low : *measure.value;
  const double high = measure.interval ? measure.interval->high : *measure.value;
  const bool is_consistency = claim.kind == ClaimKind::consistency;
  // A rule is an interval: it holds everywhere between two values with which it holds.
  if (holds(claim.rule, low) && holds(claim.rule, high))
    return is_consistency ? ClaimOutcome::consistent : ClaimOutcome::reproduced;
  if (!meets(claim.rule, low, high))
    return is_consistency ? ClaimOutcome::not_consistent : ClaimOutcome::not_reproduced;
  return ClaimOutcome::inconclusive;
}

}  // namespace

std::string_view to_string(ClaimOutcome outcome) {
  switch (outcome) {
    case ClaimOutcome::reproduced:
      return "reproduced";
    case ClaimOutcome::not_reproduced:
      return "not reproduced";
    case ClaimOutcome::consistent:
      return "consistent";
    case ClaimOutcome::not_consistent:
      return "not consistent";
    case ClaimOutcome::inconclusive:
      return "inconclusive";
    case ClaimOutcome::not_run:
      break;
  }
  return "not run";
}

namespace {

/// Claims are about the paper's configuration. A run that does not say its own is taken for one of it.
bool is_of_the_paper(const nlohmann::json& configuration) {
  const auto tracker = configuration.find("tracker");
  return tracker == configuration.end() || *tracker == to_json(profile("paper"));
}

}  // namespace

std::vector<Measure> all_measures(const RunResult& result) {
  if (result.configuration.value("quick", false) || !is_of_the_paper(result.configuration)) return {};
  std::vector<Measure> measures = figure4_measures(result);
  for (const StudyResult& study : result.studies)
    measures.insert(measures.end(), study.measures.begin(), study.measures.end());
  return measures;
}

std::vector<ClaimVerdict> judge(const std::vector<Claim>& claims, const std::vector<Measure>& measures) {
  std::vector<ClaimVerdict> verdicts;
  for (const Claim& claim : claims) {
    const auto measure = std::ranges::find(measures, claim.measure, &Measure::name);
    if (measure == measures.end())
      verdicts.push_back({claim, std::nullopt, ClaimOutcome::not_run});
    else
      verdicts.push_back({claim, *measure, judge(claim, *measure)});
  }
  return verdicts;
}

bool required_claim_failed(const std::vector<ClaimVerdict>& verdicts) {
  return std::ranges::any_of(verdicts, [](const ClaimVerdict& verdict) {
    if (!verdict.claim.required) return false;
    if (verdict.measure && !verdict.measure->value) return true;
    return (verdict.outcome == ClaimOutcome::not_reproduced || verdict.outcome == ClaimOutcome::not_consistent);
  });
}

bool any_was_run(const std::vector<ClaimVerdict>& verdicts) {
  return std::ranges::any_of(verdicts, [](const ClaimVerdict& v) { return v.outcome != ClaimOutcome::not_run; });
}

}  // namespace glovebench::reports
