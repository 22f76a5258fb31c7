#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "reports/claims/claims.h"
#include "reports/results.h"

namespace glovebench::reports {

enum class ClaimOutcome { reproduced, not_reproduced, consistent, not_consistent, inconclusive, not_run };
/// "not reproduced"
std::string_view to_string(ClaimOutcome outcome);

/// What a run says about a claim.
struct ClaimVerdict {
  Claim claim;
  std::optional<Measure> measure;  ///< empty if it was not run
  ClaimOutcome outcome = ClaimOutcome::not_run;

  friend bool operator==(const ClaimVerdict&, const ClaimVerdict&) = default;
};

/// The measures of figures 4 to 6, as far as their experiments were run, and those of all studies; none of a quick
/// run, from whose few frames nothing is concluded, and none of another configuration than the paper's.
std::vector<Measure> all_measures(const RunResult& result);

/// One verdict a claim, in their order. A claim holds if the whole interval of its measure satisfies the rule, does
/// not if none of the interval does, and is inconclusive in between. A measure without an interval is judged by its
/// value, one without a value is inconclusive.
std::vector<ClaimVerdict> judge(const std::vector<Claim>& claims, const std::vector<Measure>& measures);

/// Whether a claim that is required does not hold, or was run and has no value: a tracker that answers nothing
/// keeps no promise. What is inconclusive or was not run has not failed.
bool required_claim_failed(const std::vector<ClaimVerdict>& verdicts);
/// Whether any claim was run at all.
bool any_was_run(const std::vector<ClaimVerdict>& verdicts);

}  // namespace glovebench::reports
