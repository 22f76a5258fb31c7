#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/json_cursor.h"
#include "reports/statistics.h"

namespace glovebench::reports {

/// No error is larger (a kilometre, in mm), so that sums and squares of what a file holds stay finite.
inline constexpr double kLargestError = 1e6;

/// An aggregate as every report writes it, without an interval.
nlohmann::ordered_json aggregate_json(const Aggregate& aggregate);
/// Reads the members back, whatever others there are; throws Error unless values lie in 0..kLargestError.
Aggregate read_aggregate(const JsonCursor& json);

/// An interval as every report writes it; null for none.
nlohmann::ordered_json interval_json(const std::optional<ConfidenceInterval>& interval);
/// Reads it back; throws Error unless both ends lie in min..max.
std::optional<ConfidenceInterval> read_interval(const JsonCursor& json, double min, double max);

}  // namespace glovebench::reports
