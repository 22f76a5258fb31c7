#pragma once

#include <string>
#include <vector>

#include "reports/claims/verdicts.h"

namespace glovebench::reports {

/// "3.88 [3.50, 4.20] mm", with p of required claims; "-": no value.
std::string measured_text(const ClaimVerdict& verdict);
/// "below 10 mm", "above 0.5 (ours)".
std::string rule_text(const ClaimVerdict& verdict);
std::string count_text(const std::vector<ClaimVerdict>& verdicts);
std::string required_text(const std::vector<ClaimVerdict>& verdicts);
/// How many claims that are not required would hold by chance: at most 5% of those with an interval.
std::string chance_text(const std::vector<ClaimVerdict>& verdicts);
/// With a summary of the claims' histories.
std::string judging_text();

/// At most 80 columns. Then `if_not` of claims that do not hold.
std::string claims_table(const std::vector<ClaimVerdict>& verdicts);
/// For summary.md. Empty if nothing was run.
std::string claims_markdown(const std::vector<ClaimVerdict>& verdicts);
/// tables/claims.csv.
std::string claims_csv(const std::string& run, const std::vector<ClaimVerdict>& verdicts);
/// With histories and judging.
std::string claims_json(const std::vector<ClaimVerdict>& verdicts);
/// HTML with histories; failed and open claims are unfolded.
std::string claims_section(const std::vector<ClaimVerdict>& verdicts);

}  // namespace glovebench::reports
