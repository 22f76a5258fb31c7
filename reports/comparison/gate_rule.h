#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/comparison/speed.h"

// A change stops if any compared metric, in an experiment or over all, rises by its minimum effect with an
// interval above zero, or by twice that (a share of frames: once) whatever the interval, or if a fast path is
// slower than its limit (speed.h).

namespace glovebench::reports {

/// What another machine can cause; for a share, at least two frames. `frames`: of all seeds.
double least_effect(const Metric& metric, int frames);
/// The noise floor's effect or the default; at least least_effect. Grows if a result has fewer `seeds` than the
/// floor. `floor` may be null.
double minimum_effect(const Metric& metric, std::string_view experiment, int frames, int seeds,
                      const NoiseFloor* floor);

/// False without interval, or if it does not decide and has fewer than kFewestBlocks.
bool shows_interval(const ComparisonRow& row);
Verdict verdict_of(const ComparisonRow& row);
bool stops(const ComparisonRow& row);
/// The row stops, but is not `worse`.
bool is_worse_in_places(const ComparisonRow& row);
/// The least to add to every candidate frame so that the row stops. The row must have a difference.
double missing_to_stop(const ComparisonRow& row);

struct GateDecision {
  std::vector<std::string> failures;  ///< one line each: experiment, metric, numbers
  std::vector<std::string> warnings;  ///< possible regressions without enough data; gaps
  bool has_places = false;
  bool passed() const { return failures.empty(); }
};
GateDecision decide(const Comparison& comparison, const std::vector<SpeedRow>& speed);

}  // namespace glovebench::reports
