#pragma once

#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/speed.h"

namespace glovebench::reports {

/// What lets a change pass or stops it.
struct GateDecision {
  std::vector<std::string> failures;  ///< a line each: experiment, metric, numbers
  std::vector<std::string> warnings;  ///< what could be a regression, but the data do not say so
  bool passed() const { return failures.empty(); }
};

/// The difference that stops a change whatever the interval says, even if there is none: kSurely minimum effects,
/// and of a share of frames one. What went wrong in one stretch of a movement is nothing that an interval over its
/// few blocks can tell from chance; on the same frames it is a fact, and the minimum effect already holds what
/// other seeds do.
double sure_effect(const ComparisonRow& row);
inline constexpr double kSurely = 2;
/// Does this row stop a change? If it is worse, or rose by its sure effect.
bool stops(const ComparisonRow& row);
GateDecision decide(const Comparison& comparison, const std::vector<SpeedRow>& speed);

}  // namespace glovebench::reports
