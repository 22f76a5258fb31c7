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
  withdrawn
};
constexpr auto names_of(ClaimOutcome) {
  return std::to_array<std::string_view>(
      {"reproduced", "not reproduced", "consistent", "not consistent", "inconclusive", "not run", "withdrawn"});
}

struct ClaimVerdict {
  Claim claim;
  std::optional<Measure> measure;  ///< empty if not run; no NaN or infinity
  ClaimOutcome outcome = ClaimOutcome::not_run;
  std::optional<double> p = {};  ///< that the rule is broken (Holm), of required claims with an interval

  friend bool operator==(const ClaimVerdict&, const ClaimVerdict&) = default;
};

/// False for a quick run, or with another configuration than the paper's.
bool are_claims_judged(const RunResult& result);

/// Measures of Figures 4 to 6 and studies, if run. Empty if claims are not judged.
std::vector<Measure> all_measures(const RunResult& result);

/// Two-sided p-value of a broken rule: 1 if the number breaks it, 0.05 if the 95% interval touches the bound. In
/// between, it follows Student's t with 4 degrees of freedom (five blocks). Its scale is the interval's arm toward
/// the bound, or half its width if longer.
double p_value(const Rule& rule, double value, const ConfidenceInterval& interval);

/// Judges (reports/README.md, "Claims"), in the order of the claims.
std::vector<ClaimVerdict> judge(const std::vector<Claim>& claims, const std::vector<Measure>& measures);

/// Outcomes of required claims that are not withdrawn.
struct RequiredClaims {
  int hold = 0;
  int inconclusive = 0;  ///< part of the interval breaks the rule
  int failed = 0;        ///< does not hold, or has no value or an invalid interval
  int not_run = 0;

  friend bool operator==(const RequiredClaims&, const RequiredClaims&) = default;
};
RequiredClaims count_required(const std::vector<ClaimVerdict>& verdicts);

bool any_was_run(const std::vector<ClaimVerdict>& verdicts);

}  // namespace glovebench::reports
