#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/speed.h"

// The rule that stops a change: a change fails if a row of its comparison is significantly worse by at least the
// row's minimum effect, if a row rose by its sure effect whatever its interval says, or if a stage became slower.
//
// A difference reaches its minimum effect when it is as large as other noise seeds make it once in a hundred
// comparisons (noise floor), or as a default says, and never smaller than what another machine does or than two
// frames of a share. The sure effect is two minimum effects, and of a share of frames one. What went wrong in one
// stretch of a movement is nothing that an interval over its few blocks can tell from chance; on the same frames it
// is a fact, and the minimum effect already holds what other seeds do.

namespace glovebench::reports {

/// Another machine can cause less; for a share it is at least two frames. `frames` of all seeds.
double least_effect(const Metric& metric, int frames);
/// The noise floor's effect or the default, at least least_effect. It grows if a result has fewer `seeds` than the
/// floor is for, since their mean varies more. `floor` may be null.
double minimum_effect(const Metric& metric, std::string_view experiment, int frames, int seeds,
                      const NoiseFloor* floor);

/// Whether the row's interval can be read: not if too few blocks decide nothing.
bool has_interval(const ComparisonRow& row);
/// From difference, interval and minimum effect.
Verdict verdict_of(const ComparisonRow& row);
/// Whether the row is worse, or rose by its sure effect.
bool stops(const ComparisonRow& row);
/// Whether the row stops although its interval, over a few blocks of frames, cannot tell the rise from chance.
bool is_worse_in_places(const ComparisonRow& row);
/// What must be added to every candidate frame for the row to stop the change. The row has a difference.
double missing_to_stop(const ComparisonRow& row);

struct GateDecision {
  std::vector<std::string> failures;  ///< one line each: experiment, metric, numbers
  std::vector<std::string> warnings;  ///< possible regressions without enough data, and gaps in the comparison
  bool has_places = false;            ///< a failure is worse in places
  bool passed() const { return failures.empty(); }
};
GateDecision decide(const Comparison& comparison, const std::vector<SpeedRow>& speed);

}  // namespace glovebench::reports
