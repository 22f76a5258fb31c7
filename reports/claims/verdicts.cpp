#include "reports/claims/verdicts.h"

#include <algorithm>

#include "reports/claims/figure4_measures.h"

namespace glovebench::reports {
namespace {

Outcome judge(const Claim& claim, const Measure& measure) {
  if (!measure.value && !measure.interval) return Outcome::inconclusive;
  const double low = measure.interval ? measure.interval->low : *measure.value;
  const double high = measure.interval ? measure.interval->high : *measure.value;
  const bool is_consistency = claim.kind == ClaimKind::consistency;
  // A rule is an interval: it holds everywhere between two values with which it holds.
  if (holds(claim.rule, low) && holds(claim.rule, high))
    return is_consistency ? Outcome::consistent : Outcome::reproduced;
  if (!meets(claim.rule, low, high)) return is_consistency ? Outcome::not_consistent : Outcome::not_reproduced;
  return Outcome::inconclusive;
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::reproduced:
      return "reproduced";
    case Outcome::not_reproduced:
      return "not reproduced";
    case Outcome::consistent:
      return "consistent";
    case Outcome::not_consistent:
      return "not consistent";
    case Outcome::inconclusive:
      return "inconclusive";
    case Outcome::not_run:
      break;
  }
  return "not run";
}

std::vector<Measure> all_measures(const RunResult& result) {
  std::vector<Measure> measures = figure4_measures(result);
  for (const StudyResult& study : result.studies)
    measures.insert(measures.end(), study.measures.begin(), study.measures.end());
  return measures;
}

std::vector<Verdict> judge(const std::vector<Claim>& claims, const std::vector<Measure>& measures) {
  std::vector<Verdict> verdicts;
  for (const Claim& claim : claims) {
    const auto measure = std::ranges::find(measures, claim.measure, &Measure::name);
    if (measure == measures.end())
      verdicts.push_back({claim, std::nullopt, Outcome::not_run});
    else
      verdicts.push_back({claim, *measure, judge(claim, *measure)});
  }
  return verdicts;
}

bool required_claim_failed(const std::vector<Verdict>& verdicts) {
  return std::ranges::any_of(verdicts, [](const Verdict& verdict) {
    return verdict.claim.required &&
           (verdict.outcome == Outcome::not_reproduced || verdict.outcome == Outcome::not_consistent);
  });
}

bool any_was_run(const std::vector<Verdict>& verdicts) {
  return std::ranges::any_of(verdicts, [](const Verdict& v) { return v.outcome != Outcome::not_run; });
}

}  // namespace glovebench::reports
