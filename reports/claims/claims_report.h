#pragma once

#include <string>
#include <vector>

#include "reports/claims/verdicts.h"

namespace glovebench::reports {

// Verdicts as they are written down. Values have a measure's unit. All of these depend on times as well, since some
// claims are about times.

/// The measure's value and interval with its unit, to read: "3.88 [3.50, 4.20] mm"; "-" for none.
std::string measured_text(const ClaimVerdict& verdict);
/// The rule with the measure's unit: "below 10 mm".
std::string rule_text(const ClaimVerdict& verdict);
/// "20 claims: 11 reproduced, ...", for a line above the claims.
std::string count_text(const std::vector<ClaimVerdict>& verdicts);
/// "3 required (*): 2 hold, 1 inconclusive, 0 failed, 0 not run", for the line after it.
std::string required_text(const std::vector<ClaimVerdict>& verdicts);
/// How claims are judged, and what their histories tell, in sentences.
std::string judging_text();

/// Aligned text of at most 120 columns, and below it what to say of the claims that do not hold.
std::string claims_table(const std::vector<ClaimVerdict>& verdicts);
/// A section for summary.md; empty if nothing was run.
std::string claims_markdown(const std::vector<ClaimVerdict>& verdicts);
/// tables/claims.csv: one line a claim.
std::string claims_csv(const std::vector<ClaimVerdict>& verdicts);
/// claims.json: everything of every verdict, the claims' histories, and how claims are and were judged.
std::string claims_json(const std::vector<ClaimVerdict>& verdicts);
/// A section for the page, with the claims' histories. Claims that were not run are folded away.
std::string claims_section(const std::vector<ClaimVerdict>& verdicts);

}  // namespace glovebench::reports
