#pragma once

#include <string>
#include <vector>

#include "reports/claims/verdicts.h"

namespace glovebench::reports {

/// "3.88 [3.50, 4.20] mm"; "-": no value.
std::string measured_text(const ClaimVerdict& verdict);
/// "below 10 mm".
std::string rule_text(const ClaimVerdict& verdict);
/// "20 claims: 11 reproduced, ...".
std::string count_text(const std::vector<ClaimVerdict>& verdicts);
/// "3 required (*): 2 hold, 1 inconclusive, 0 failed, 0 not run".
std::string required_text(const std::vector<ClaimVerdict>& verdicts);
/// How claims are judged, with a summary of their histories.
std::string judging_text();

/// At most 120 columns. Then `if_not` of claims that do not hold.
std::string claims_table(const std::vector<ClaimVerdict>& verdicts);
/// For summary.md. Empty if nothing was run.
std::string claims_markdown(const std::vector<ClaimVerdict>& verdicts);
/// tables/claims.csv.
std::string claims_csv(const std::string& run, const std::vector<ClaimVerdict>& verdicts);
/// Verdicts, histories and judging.
std::string claims_json(const std::vector<ClaimVerdict>& verdicts);
/// A section of the page with histories. Failed and open claims are unfolded.
std::string claims_section(const std::vector<ClaimVerdict>& verdicts);

}  // namespace glovebench::reports
