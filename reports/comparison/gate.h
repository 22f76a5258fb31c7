#pragma once

#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/speed.h"

namespace glovebench::reports {

/// What lets a change pass or stops it.
struct GateDecision {
  std::vector<std::string> failures;  ///< a line each: experiment, quantity, numbers
  std::vector<std::string> warnings;  ///< what could be a regression, but the data do not say so
  bool passed() const { return failures.empty(); }
};

/// Does this row stop a change? If it is worse. And if it is a share of frames that rose by its minimum effect,
/// even where the interval includes zero: lost frames come in runs, about which an interval over a few blocks says
/// little, and the noise floor already holds what other seeds do.
bool stops(const ComparisonRow& row);
GateDecision decide(const Comparison& comparison, const std::vector<SpeedRow>& speed);

}  // namespace glovebench::reports
