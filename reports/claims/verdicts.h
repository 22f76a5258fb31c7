#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "reports/claims/claims.h"
#include "reports/results.h"

namespace glovebench::reports {

enum class ClaimOutcome {
  reproduced,
  not_reproduced,
  consistent,
  not_consistent,
  inconclusive,
  not_run,
  withdrawn  ///< not judged any more, still listed
};
constexpr auto names_of(ClaimOutcome) {
  return std::to_array<std::string_view>(
      {"reproduced", "not reproduced", "consistent", "not consistent", "inconclusive", "not run", "withdrawn"});
}

/// What a run says about a claim.
struct ClaimVerdict {
  Claim claim;
  std::optional<Measure> measure;  ///< empty if it was not run; its number and interval are finite, or not there
  ClaimOutcome outcome = ClaimOutcome::not_run;

  friend bool operator==(const ClaimVerdict&, const ClaimVerdict&) = default;
};

/// Whether claims are judged from this run: not from a quick one, from whose few frames nothing is concluded, and
/// not with another configuration than the paper's.
bool are_claims_judged(const RunResult& result);

/// The measures of figures 4 to 6, as far as their experiments were run, and those of all studies; none of a run
/// from which claims are not judged.
std::vector<Measure> all_measures(const RunResult& result);

/// One verdict a claim, in their order. A claim
/// - does not hold if the measure's number breaks the rule, or the whole interval does;
/// - holds if the number and the whole interval satisfy the rule, or the number of a measure without an interval;
/// - is inconclusive if the number satisfies the rule and only a part of the interval does, if there is no number,
///   and if the interval is none (an end that is not finite, or ends in the wrong order).
std::vector<ClaimVerdict> judge(const std::vector<Claim>& claims, const std::vector<Measure>& measures);

/// How the required claims came out. Withdrawn ones are not among them.
struct RequiredClaims {
  int hold = 0;
  int inconclusive = 0;  ///< the number satisfies the rule, a part of the interval does not
  int failed = 0;        ///< does not hold, or was measured and has no value, or an interval that is none
  int not_run = 0;

  friend bool operator==(const RequiredClaims&, const RequiredClaims&) = default;
};
RequiredClaims count_required(const std::vector<ClaimVerdict>& verdicts);

/// Whether any claim was run at all.
bool any_was_run(const std::vector<ClaimVerdict>& verdicts);

}  // namespace glovebench::reports
