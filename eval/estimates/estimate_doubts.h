#pragma once

#include <optional>
#include <span>
#include <string>

#include "eval/estimates/compared_points.h"
#include "eval/estimates/joint_orders.h"

namespace glovebench::eval {

/// A sentence for the likeliest mistake in the estimates, with both mean errors. A mistake counts if its
/// correction more than halves the error, and by 5 mm (mirrored hand: 2 mm) or 3 degrees. Empty if there is none.
/// `true_points`, `answers`: one per frame.
std::optional<std::string> estimate_doubt(const PointComparison& comparison, std::span<const HandFrame> truth,
                                          std::span<const Points> true_points, std::span<const TrackResult> answers,
                                          const JointOrder& order);

}  // namespace glovebench::eval
